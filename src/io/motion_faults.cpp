#include "io/motion_faults.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/extent.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A leap is so many times longer than each of this many steps on either side, this part of the span at least, and the
// channel moves on both sides by this part of the leap: a step of the motion itself has rest on one side.
constexpr double longer = 8.0;
constexpr std::size_t steps_beside = 4;
constexpr double least_leap = 0.02;
constexpr double moving = 0.005;

// Of the stretches of one value, this share has the same length, give or take one sample, and there are so many.
constexpr double alike = 0.95;
constexpr std::size_t fewest_holds = 30;
constexpr double least_hold = 1.8;
// A converter's steps are of one or two sizes where those of a held signal are of many.
constexpr std::size_t fewest_sizes = 10;

}  // namespace

std::optional<Leap> leap_of(const std::vector<double>& time, const std::vector<double>& values) {
  Leap leap;
  for (std::size_t n = 0; n + 1 < values.size(); ++n) {
    const double step = std::fabs(values[n + 1] - values[n]);
    if (step > leap.size) leap = {n, step};
  }
  if (leap.after < steps_beside || leap.after + 1 + steps_beside >= values.size() ||
      leap.size < least_leap * span_of(values)) {
    return std::nullopt;
  }
  double before = 0.0;
  double after = 0.0;
  for (std::size_t k = 1; k <= steps_beside; ++k) {
    before = std::max(before, std::fabs(values[leap.after - k + 1] - values[leap.after - k]));
    after = std::max(after, std::fabs(values[leap.after + k + 1] - values[leap.after + k]));
  }
  const bool alone = leap.size > longer * std::max(before, after);
  const double usual = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const bool in_time = time[leap.after + 1] - time[leap.after] < 2.0 * usual;
  return in_time && alone && std::min(before, after) > moving * leap.size ? std::optional(leap) : std::nullopt;
}

std::optional<double> held_samples_of(const std::vector<double>& values) {
  std::vector<std::size_t> lengths;
  std::set<double> sizes;
  std::size_t first = 0;
  for (std::size_t n = 1; n < values.size(); ++n) {
    if (values[n] != values[n - 1]) {
      // What began before the recording is not known.
      if (first > 0) lengths.push_back(n - first);
      if (sizes.size() < fewest_sizes) sizes.insert(std::fabs(values[n] - values[n - 1]));
      first = n;
    }
  }
  if (lengths.size() < fewest_holds || sizes.size() < fewest_sizes) return std::nullopt;
  double sum = 0.0;
  for (const std::size_t length : lengths) sum += static_cast<double>(length);
  std::vector<std::size_t> sorted = lengths;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
  const std::size_t usual = sorted[sorted.size() / 2];
  const auto count_of = [&](std::size_t length) { return static_cast<double>(std::ranges::count(lengths, length)); };
  const double same = count_of(usual) + std::max(count_of(usual - 1), count_of(usual + 1));
  const auto count = static_cast<double>(lengths.size());
  if (same < alike * count || sum < least_hold * count) return std::nullopt;
  return sum / count;
}

VelocityFault velocity_fault_of(const Recording& recording) {
  VelocityFault result;
  const std::size_t size = recording.size();
  if (!recording.velocity_measured || size < 16) return result;
  const std::vector<double>& time = recording.time;
  const std::vector<double>& v = recording.velocity;
  const std::vector<double> slope = derive_velocity(time, recording.displacement);
  const double speed = peak_of(slope);
  if (!(speed > 0.0)) return result;
  double way = 0.0;
  for (std::size_t n = 1; n < size; ++n) way += 0.5 * (v[n] + v[n - 1]) * (time[n] - time[n - 1]);
  const double net = recording.displacement.back() - recording.displacement.front();
  result.offset = (way - net) / (time.back() - time.front());
  result.offset_share = std::fabs(result.offset) / speed;
  // v(t) = slope(t - lag): least squares of v - slope over -acceleration, of its slope to first order.
  const std::vector<double> acceleration = derive_acceleration(time, recording.displacement, slope, false);
  double cross = 0.0;
  double squares = 0.0;
  double speeds = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    cross -= (v[n] - slope[n] - result.offset) * acceleration[n];
    squares += acceleration[n] * acceleration[n];
    speeds += slope[n] * slope[n];
  }
  if (squares > 0.0) {
    result.lag = cross / squares;
    result.lag_share = std::fabs(result.lag) * std::sqrt(squares / speeds);
  }
  return result;
}

}  // namespace hysteron
