// The march of a model over a recording, block by block, with the parameters that follow its drive.
#pragma once

#include <algorithm>
#include <vector>

#include "fit/march_inputs.hpp"
#include "fit/target.hpp"
#include "simulate/march.hpp"

namespace hysteron {

inline constexpr std::size_t block_samples = 128;

// Marches samples [first, last) of a target block by block and hands (first sample, count, force) to the sink, those of
// the period marched beforehand to the other one. `state` holds max_states: those at the first sample, then those at
// the last; a march that begins the target starts from rest, whatever it held.
template <class T, class Parameters, class Sink, class Before>
void march_window(const CompositeModel& model, const Target& target, const Parameters& parameters_at_drive,
                  std::size_t first, std::size_t last, std::vector<T>& state, Sink&& sink, Before&& before) {
  const std::size_t width = model.parameter_count();
  const std::size_t stride = target.drive_varies ? width : 0;
  std::vector<T> p(target.drive_varies ? width * (block_samples + 1) : width);
  std::vector<T> out(block_samples);
  MarchInputs<T> excitation(model);
  const auto parameters_of = [&](const Command& command, T* values) {
    parameters_at_drive(command.drive[command.at], values);
    if (!excitation.none()) {
      parameters_at_drive(excitation.act(command, values), values);
    }
  };
  // Effects on the drive remember: every sample is asked once, and the one that ends a block begins the next.
  const auto block = [&](const Motion& motion, std::size_t begin, std::size_t end, bool goes_on) {
    if (target.drive_varies) {
      if (goes_on) {
        std::copy_n(p.data() + block_samples * width, width, p.data());
      }
      for (std::size_t n = begin + (goes_on ? 1 : 0); n < std::min(end + 1, motion.time.size()); ++n) {
        parameters_of({motion.time, motion.drive, n}, p.data() + (n - begin) * width);
      }
    }
    model.march<T>(motion, p.data(), stride, begin, end, state.data(), out.data());
  };
  if (!target.drive_varies) {
    const double instant = 0.0;
    parameters_of({{&instant, 1}, {&target.drive, 1}, 0}, p.data());
  }
  if (first == 0) {
    std::ranges::fill(state, T(0.0));
    for (std::size_t begin = 0; begin < target.preroll; begin += block_samples) {
      const std::size_t end = std::min(begin + block_samples, target.preroll);
      block(target.lead_in, begin, end, begin > 0);
      before(begin, end - begin, out.data());
    }
  } else if (target.drive_varies && !excitation.none()) {
    // What the effects on the drive remember, from the start of the recording.
    for (std::size_t n = 0; n < first; ++n) {
      parameters_of({target.motion.time, target.motion.drive, n}, p.data());
    }
  }
  for (std::size_t begin = first; begin < last; begin += block_samples) {
    const std::size_t end = std::min(begin + block_samples, last);
    block(target.motion, begin, end, begin > first);
    sink(begin, end - begin, out.data());
  }
}

// The whole target.
template <class T, class Parameters, class Sink, class Before>
void march_target(const CompositeModel& model, const Target& target, const Parameters& parameters_at_drive, Sink&& sink,
                  Before&& before) {
  std::vector<T> state(max_states);
  march_window<T>(model, target, parameters_at_drive, 0, target.force.size(), state, sink, before);
}

}  // namespace hysteron
