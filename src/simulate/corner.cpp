#include "simulate/corner.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// Change of velocity over a corner: at least so much of the largest speed around, as for derived velocities
// (io/velocity.cpp). Less is the noise of a held rod.
constexpr double least_bend = 0.2;
// Samples to each side that are around: no more, so that the cost of a corner is bounded.
constexpr std::size_t around = 10000;
// What the velocity of either side may change by from sample to sample, over the bend.
constexpr double steady = 0.05;
// Where the lines may meet outside the interval, as theta: noise moves them.
constexpr double slack = 0.1;
// A sample on a corner has the speed of neither side. Its share of the bend is within this of a half, as it lies within
// a quarter of a step of the corner (io/velocity.hpp).
constexpr double of_the_mean = 0.3;

// Samples at the ends of two lines, `left` and `right`.
struct Lines {
  std::span<const double> t;
  std::span<const double> x;
  std::span<const double> v;
  std::size_t left;
  std::size_t right;

  [[nodiscard]] double bend() const { return v[right] - v[left]; }
  [[nodiscard]] double left_slope() const { return (v[left] - v[left - 1]) / (t[left] - t[left - 1]); }
  [[nodiscard]] double right_slope() const { return (v[right + 1] - v[right]) / (t[right + 1] - t[right]); }
  [[nodiscard]] bool meet_sharply() const {
    if (left < 1 || right + 1 >= t.size()) return false;
    const double size = std::fabs(bend());
    return size > 0.0 && std::fabs(v[left] - v[left - 1]) <= steady * size &&
           std::fabs(v[right + 1] - v[right]) <= steady * size && is_large(size);
  }
  [[nodiscard]] bool is_large(double size) const {
    const auto from = v.begin() + static_cast<std::ptrdiff_t>(left - std::min(left, around));
    const auto to = v.begin() + static_cast<std::ptrdiff_t>(std::min(right + around, v.size() - 1));
    return std::none_of(from, to + 1, [&](double speed) { return least_bend * std::fabs(speed) > size; });
  }
  // When they meet, s.
  [[nodiscard]] double meet() const {
    const double h = t[right] - t[left];
    return t[left] + (x[right] - x[left] - v[right] * h) / (v[left] - v[right]);
  }
};

// Along the interval [from, to] with a corner between the ends of the lines at time `meet`, maybe outside of it.
VelocityCorner along(const Lines& lines, double meet, double from, double to) {
  const double left_slope = lines.left_slope();
  const double right_slope = lines.right_slope();
  return {.start = lines.v[lines.left] + left_slope * (from - lines.t[lines.left]),
          .start_slope = left_slope,
          .end = lines.v[lines.right] - right_slope * (lines.t[lines.right] - to),
          .end_slope = right_slope,
          .at = std::clamp((meet - from) / (to - from), 0.0, 1.0)};
}

}  // namespace

std::optional<VelocityCorner> corner_of(std::span<const double> time, std::span<const double> displacement,
                                        std::span<const double> velocity, std::size_t n) {
  const double from = time[n];
  const double to = time[n + 1];
  const Lines inside{time, displacement, velocity, n, n + 1};
  if (inside.meet_sharply()) {
    const double meet = inside.meet();
    const double over = slack * (to - from);
    if (meet >= from - over && meet <= to + over) return along(inside, meet, from, to);
  }
  for (const std::size_t on : {n, n + 1}) {
    if (on == 0 || on + 1 >= time.size()) continue;
    const Lines across{time, displacement, velocity, on - 1, on + 1};
    if (!across.meet_sharply()) continue;
    const double share = (velocity[on] - velocity[on - 1]) / across.bend();
    const double meet = across.meet();
    const double near = 0.5 * std::min(time[on] - time[on - 1], time[on + 1] - time[on]);
    if (std::fabs(share - 0.5) <= of_the_mean && std::fabs(meet - time[on]) <= near) {
      return along(across, meet, from, to);
    }
  }
  return std::nullopt;
}

}  // namespace hysteron
