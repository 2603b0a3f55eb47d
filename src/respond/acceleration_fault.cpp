#include "respond/acceleration_fault.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/extent.hpp"
#include "core/mean.hpp"
#include "core/squared.hpp"
#include "io/velocity.hpp"
#include "respond/motion_windows.hpp"

namespace hysteron {
namespace {

// As of a velocity over the slope of the displacement (io/plausible.cpp): a channel is rarely calibrated worse.
constexpr double worst_gain = 1.15;
// Less than a third of what follows is something else: more than any noise leaves in the mean over a period.
constexpr double least_shared = 0.9;
// Of the mean square of the displacement's second derivative, up to which its noise does not hide what is shared.
constexpr double most_noise = 0.01;
// Of the mean square of a recorded acceleration in the windows: of one with more noise nothing is told.
constexpr double least_clear = 0.9;
// Of the largest acceleration: from here on it is seen in a constant force, as with an offset of the velocity.
constexpr double least_offset = 0.1;
// The other explanation has to leave a quarter, half in amplitude.
constexpr double far_better = 0.25;

using Kind = AccelerationFault::Kind;

bool is_alike(const Following& following) {
  return following.shared >= least_shared && following.gain < worst_gain && following.gain > 1.0 / worst_gain;
}

std::vector<double> sum_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result = a;
  for (std::size_t n = 0; n < result.size(); ++n) result[n] += b[n];
  return result;
}

// Where the displacement tells a tenth of its largest or more: beside that, as after a decay, there is only noise.
std::vector<std::size_t> moving_windows(const std::vector<double>& told) {
  constexpr double least = 0.1;
  const double middle = mean_of(told);
  double largest = 0.0;
  for (const double value : told) largest = std::max(largest, std::fabs(value - middle));
  std::vector<std::size_t> result;
  for (std::size_t n = 0; n < told.size(); ++n) {
    if (std::fabs(told[n] - middle) >= least * largest) result.push_back(n);
  }
  return result;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& at) {
  std::vector<double> result(at.size());
  std::ranges::transform(at, result.begin(), [&](std::size_t n) { return values[n]; });
  return result;
}

// Whether it is that of the base that is recorded, or contains it.
std::optional<AccelerationFault> with_base(const Recording& recording, const MotionWindows& windows,
                                           const std::vector<std::size_t>& moving, const std::vector<double>& relative,
                                           const std::vector<double>& acceleration) {
  if (recording.base.empty() || span_of(recording.base) == 0.0) return std::nullopt;
  const double left = following_of(relative, acceleration).misfit;
  const std::vector<double> base = picked(windows.bends_of(recording.base), moving);
  for (const auto& [kind, expected] :
       {std::pair(Kind::absolute, sum_of(relative, base)), std::pair(Kind::of_base, base)}) {
    const Following following = following_of(expected, acceleration);
    if (is_alike(following) && following.misfit < far_better * left) return AccelerationFault{kind, following.gain};
  }
  return std::nullopt;
}

}  // namespace

std::optional<AccelerationFault> acceleration_fault_of(const Recording& recording) {
  if (recording.acceleration.empty() || recording.displacement.empty()) return std::nullopt;
  const MotionWindows windows(recording);
  if (windows.few()) return std::nullopt;
  const std::vector<double> all = windows.bends_of(recording.displacement);
  const std::vector<std::size_t> moving = moving_windows(all);
  if (moving.size() < MotionWindows::fewest) return std::nullopt;
  const std::vector<double> told = picked(all, moving);
  const double square = mean_square_about_mean(told);
  const double noise = channel_noise(recording.time, recording.displacement) * windows.noise_of_bends();
  if (!(squared(noise) < most_noise * square)) return std::nullopt;
  const std::vector<double> recorded = picked(windows.means_of(recording.acceleration), moving);
  if (const auto fault = with_base(recording, windows, moving, told, recorded)) return fault;
  Following following = following_of(told, recorded);
  // What its own noise leaves to share, and adds to its size.
  const double own_noise = channel_noise(recording.time, recording.acceleration) * windows.noise_of_means();
  const double clear = 1.0 - squared(own_noise) / mean_square_about_mean(recorded);
  if (!(clear > least_clear)) return std::nullopt;
  if (following.shared < least_shared * clear) {
    return AccelerationFault{Kind::foreign, std::copysign(std::sqrt(following.shared), following.gain)};
  }
  following.gain *= std::sqrt(clear);
  if (following.gain < 0.0) return AccelerationFault{Kind::reversed, -following.gain};
  if (following.gain >= worst_gain || following.gain <= 1.0 / worst_gain) {
    return AccelerationFault{Kind::factor, following.gain};
  }
  std::vector<double> without = recording.acceleration;
  for (double& value : without) value -= following.offset;
  if (std::fabs(following.offset) > least_offset * peak_of(without)) {
    return AccelerationFault{Kind::offset, following.offset};
  }
  return std::nullopt;
}

}  // namespace hysteron
