// The march of a model over a recording, block by block, with the parameters that follow its drive.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "fit/march_inputs.hpp"
#include "fit/target.hpp"
#include "simulate/lean_motion.hpp"
#include "simulate/march.hpp"

namespace hysteron {

inline constexpr std::size_t block_samples = 128;

// A march of a target in pieces of block_samples. parameters_at(drive, conditions, p) writes the parameters at a drive
// and at values of the conditions.
template <class T, class Parameters>
class Marcher {
 public:
  Marcher(const CompositeModel& model, const Target& target, Parameters parameters_at)
      : model_(model),
        target_(target),
        parameters_at_(std::move(parameters_at)),
        width_(model.parameter_count()),
        conditions_(target.conditions.size()),
        p_(target.inputs_vary ? width_ * (block_samples + 1) : width_),
        out_(block_samples),
        excitation_(model) {}

  // Goes to sample `first`: at 0 to the start of the recording, whatever `state` held, over the period marched
  // beforehand, which `before` is handed; elsewhere `state` is that at the sample.
  template <class Before>
  void start(std::size_t first, std::vector<T>& state, Before&& before) {
    if (!target_.inputs_vary) {
      const double instant = 0.0;
      parameters_of({{&instant, 1}, {&target_.drive, 1}, 0}, p_.data());
    }
    if (first == 0) {
      begins_ = true;
      for (std::size_t begin = 0; begin < target_.preroll; begin += block_samples) {
        const std::size_t end = std::min(begin + block_samples, target_.preroll);
        march(target_.lead_in, begin, end, state, begin > 0);
        before(begin, end - begin, out_.data());
      }
      // Travel, heat and wear count from the first sample: what was before it is not known.
      again_ = target_.preroll > 0;
    } else if (target_.inputs_vary && !excitation_.none()) {
      // What the effects on the drive remember, from the start of the recording.
      for (std::size_t n = 0; n < first; ++n) {
        parameters_of({target_.motion.time, target_.motion.drive, n}, p_.data());
      }
    }
    goes_on_ = false;
  }

  // Forces of samples [begin, end), block_samples at most; `begin` is where the block before ended, whose state it
  // takes, and all blocks but the last are full.
  const T* block(std::size_t begin, std::size_t end, std::vector<T>& state) {
    march(target_.motion, begin, end, state, goes_on_);
    goes_on_ = true;
    return out_.data();
  }

 private:
  void parameters_of(const Command& command, T* values) {
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      const std::vector<double>& along = target_.conditions[c];
      conditions_[c] = along.size() > 1 ? along[command.at] : along[0];
    }
    const std::span<const double> conditions(conditions_);
    parameters_at_(command.drive[command.at], conditions, values);
    if (!excitation_.none()) {
      parameters_at_(excitation_.act(command, values), conditions, values);
    }
  }

  // Effects on the drive remember: every sample is asked once, and the one that ends a block begins the next.
  void march(const Motion& motion, std::size_t begin, std::size_t end, std::vector<T>& state, bool goes_on) {
    const std::size_t samples = motion.time.size();
    if (target_.inputs_vary) {
      if (goes_on) {
        std::copy_n(p_.data() + block_samples * width_, width_, p_.data());
      }
      for (std::size_t n = begin + (goes_on ? 1 : 0); n < std::min(end + 1, samples); ++n) {
        parameters_of({motion.time, motion.drive, n}, p_.data() + (n - begin) * width_);
      }
    }
    if (begins_) {
      model_.begin<T>(p_.data(), target_.earlier, state.data());
      begins_ = false;
    }
    if (again_ && &motion == &target_.motion) {
      model_.for_links([&](const Link& link) {
        const auto begin_part = link.part->on<T>().begin;
        if (begin_part != nullptr) begin_part(p_.data() + link.parameter, target_.earlier, state.data() + link.state);
      });
      again_ = false;
    }
    const std::size_t stride = target_.inputs_vary ? width_ : 0;
    if (!is_lean(motion)) {
      model_.march<T>(motion, p_.data(), stride, begin, end, state.data(), out_.data());
      return;
    }
    // With the interval before and the one after, which tell what is near a reversal.
    const std::size_t first = begin > 0 ? begin - 1 : 0;
    prepare(motion, first, std::min(end + 2, samples), piece_);
    model_.march<T>(piece_, p_.data(), stride, begin - first, end - first, state.data(), out_.data());
  }

  const CompositeModel& model_;
  const Target& target_;
  Parameters parameters_at_;
  std::size_t width_;
  std::vector<double> conditions_;  // at the sample
  std::vector<T> p_;
  std::vector<T> out_;
  MarchInputs<T> excitation_;
  Motion piece_;
  bool goes_on_ = false;
  bool begins_ = false;
  bool again_ = false;  // the period marched beforehand is over
};

// Marches samples [first, last) of a target block by block and hands (first sample, count, force) to the sink, those of
// the period marched beforehand to the other one. `state` holds max_states: those at the first sample, then those at
// the last; a march that begins the target starts as the recording does, whatever it held.
template <class T, class Parameters, class Sink, class Before>
void march_window(const CompositeModel& model, const Target& target, const Parameters& parameters_at, std::size_t first,
                  std::size_t last, std::vector<T>& state, Sink&& sink, Before&& before) {
  Marcher<T, const Parameters&> marcher(model, target, parameters_at);
  marcher.start(first, state, before);
  for (std::size_t begin = first; begin < last; begin += block_samples) {
    const std::size_t end = std::min(begin + block_samples, last);
    const T* out = marcher.block(begin, end, state);
    sink(begin, end - begin, out);
  }
}

// The whole target.
template <class T, class Parameters, class Sink, class Before>
void march_target(const CompositeModel& model, const Target& target, const Parameters& parameters_at, Sink&& sink,
                  Before&& before) {
  std::vector<T> state(max_states);
  march_window<T>(model, target, parameters_at, 0, target.motion.time.size(), state, sink, before);
}

}  // namespace hysteron
