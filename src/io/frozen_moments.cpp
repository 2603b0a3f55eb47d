#include "io/frozen_moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/extent.hpp"
#include "io/channel_faults.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// Two or three samples of one value may be one that came late, and what follows is no longer than three steps.
constexpr std::size_t fewest_samples = 4;
// The channel moves on one way by each of so many steps before and behind: rounding to a coarse quantum, and noise that
// is as large as the steps, let it rest or turn in between.
constexpr std::size_t steps_beside = 4;
// The jump is so many times longer than any of these, and than the quantum.
constexpr double longer = 2.0;
constexpr double least_quanta = 3.0;
// It goes as far as the speeds tell, give or take this part of it: near the end of a stroke these differ by a factor of
// two and their mean is off by so much.
constexpr double near = 0.35;

}  // namespace

std::optional<FrozenMoments> frozen_moments_of(const Recording& recording) {
  const std::vector<double>& time = recording.time;
  const std::vector<double>& x = recording.displacement;
  if (x.empty() || time.size() != x.size()) return std::nullopt;
  const double quantum = channel_quantum(x);
  FrozenMoments result;
  result.force_holds = recording.force.size() == x.size();
  double furthest = 0.0;
  for_each_run(x, [&](std::size_t first, std::size_t count) {
    const std::size_t last = first + count - 1;
    if (count < fewest_samples || first < steps_beside || last + 1 + steps_beside >= x.size()) return;
    const double jump = std::fabs(x[last + 1] - x[last]);
    const double way = std::copysign(1.0, x[last + 1] - x[last]);
    double widest = 0.0;
    for (std::size_t k = 0; k < steps_beside; ++k) {
      const double before = way * (x[first - k] - x[first - k - 1]);
      const double behind = way * (x[last + 2 + k] - x[last + 1 + k]);
      if (!(std::min(before, behind) > 0.0)) return;
      widest = std::max({widest, before, behind});
    }
    if (jump <= longer * widest || jump < least_quanta * quantum) return;
    const auto speed = [&](std::size_t from) {
      return std::fabs(x[from + steps_beside] - x[from]) / (time[from + steps_beside] - time[from]);
    };
    const double told = 0.5 * (speed(first - steps_beside) + speed(last + 1)) * (time[last + 1] - time[first]);
    if (std::fabs(jump - told) > near * told) return;
    ++result.count;
    result.force_holds = result.force_holds && span_of(std::span(recording.force).subspan(first, count)) == 0.0;
    if (jump <= furthest) return;
    furthest = jump;
    result.first = first;
    result.last = last;
  });
  return result.count > 0 ? std::optional(result) : std::nullopt;
}

std::string sentence_of(const FrozenMoments& frozen, const Recording& recording) {
  const std::vector<double>& x = recording.displacement;
  return fmt::format(
      "the displacement{} at exactly {:.4g} mm from {:.4g} to {:.4g} s and is {:.3g} mm further at the next sample, as "
      "far as its speed before and behind would have taken it, {} time{} like that: {} looks so; its slope is 0 there "
      "and far too high behind, which shifts damping and stiffness; cut these samples",
      frozen.force_holds ? " stays, and the force with it," : " stays", 1e3 * x[frozen.first],
      recording.time[frozen.first], recording.time[frozen.last], 1e3 * std::fabs(x[frozen.last + 1] - x[frozen.last]),
      frozen.count, frozen.count == 1 ? "" : "s",
      frozen.force_holds ? "a logger that repeats a row while it waits" : "a channel that froze for a moment");
}

}  // namespace hysteron
