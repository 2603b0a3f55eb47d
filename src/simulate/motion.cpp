#include "simulate/motion.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// Slopes of the interpolant at the samples: three-point differences on the non-uniform grid.
std::vector<double> slopes(std::span<const double> t, std::span<const double> y) {
  const std::size_t n = t.size();
  std::vector<double> slope(n, 0.0);
  if (n < 3) {
    if (n == 2) {
      slope[0] = slope[1] = (y[1] - y[0]) / (t[1] - t[0]);
    }
    return slope;
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double left = t[k] - t[k - 1];
    const double right = t[k + 1] - t[k];
    slope[k] = ((y[k] - y[k - 1]) / left * right + (y[k + 1] - y[k]) / right * left) / (left + right);
  }
  slope[0] = 2.0 * (y[1] - y[0]) / (t[1] - t[0]) - slope[1];
  slope[n - 1] = 2.0 * (y[n - 1] - y[n - 2]) / (t[n - 1] - t[n - 2]) - slope[n - 2];
  return slope;
}

void hermite(double h, double y0, double y1, double slope0, double slope1, double* c) {
  const double rise = y1 - y0;
  c[0] = y0;
  c[1] = h * slope0;
  c[2] = 3.0 * rise - h * (2.0 * slope0 + slope1);
  c[3] = h * (slope0 + slope1) - 2.0 * rise;
}

// Where a cubic with opposite signs at 0 and 1 crosses zero, by bisection to the last bit.
double zero_crossing(const double* c) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double value = ((c[3] * middle + c[2]) * middle + c[1]) * middle + c[0];
    ((value < 0.0) == (c[0] < 0.0) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Motion make_motion(std::span<const double> time, std::span<const double> displacement, std::span<const double> velocity,
                   std::span<const double> drive, double tolerance, std::span<const double> acceleration) {
  Motion motion;
  // Parts count time from the start of the recording.
  for (const double t : time) {
    motion.time.push_back(t - time[0]);
  }
  motion.x.assign(displacement.begin(), displacement.end());
  motion.v.assign(velocity.begin(), velocity.end());
  motion.drive.assign(drive.begin(), drive.end());
  motion.step_limit = 0.5 * std::min(2.0, std::pow(tolerance / 1e-4, 0.25));
  const std::vector<double> slope = slopes(time, velocity);
  motion.a = acceleration.empty() ? slope : std::vector<double>(acceleration.begin(), acceleration.end());
  motion.jerk = slopes(time, motion.a);
  motion.intervals.resize(time.empty() ? 0 : time.size() - 1);
  for (std::size_t n = 0; n < motion.intervals.size(); ++n) {
    MotionInterval& interval = motion.intervals[n];
    interval.length = time[n + 1] - time[n];
    hermite(interval.length, displacement[n], displacement[n + 1], velocity[n], velocity[n + 1], interval.x);
    hermite(interval.length, velocity[n], velocity[n + 1], slope[n], slope[n + 1], interval.v);
    hermite(interval.length, motion.a[n], motion.a[n + 1], motion.jerk[n], motion.jerk[n + 1], interval.a);
    interval.middle[0] = cubic(interval.x, 0.5);
    interval.middle[1] = cubic(interval.v, 0.5);
    interval.middle[2] = cubic(interval.a, 0.5);
    interval.middle[3] = cubic_slope(interval.a, 0.5) / interval.length;
    interval.end[0] = cubic(interval.x, 1.0);
    interval.end[1] = cubic(interval.v, 1.0);
    interval.end[2] = cubic(interval.a, 1.0);
    interval.end[3] = cubic_slope(interval.a, 1.0) / interval.length;
    // A Hermite cubic stays within its end values plus 4/27 of h |slope| of either end.
    interval.speed = std::max(std::fabs(velocity[n]), std::fabs(velocity[n + 1])) +
                     4.0 / 27.0 * interval.length * (std::fabs(slope[n]) + std::fabs(slope[n + 1]));
    interval.reversal = velocity[n] * velocity[n + 1] < 0.0;
    interval.reversal_at = interval.reversal ? zero_crossing(interval.v) : 1.0;
  }
  return motion;
}

Motion comparing_motion(Motion motion) {
  motion.step_limit = 1.5;
  motion.finer_at_reversals = 1.0;
  motion.finer_when_long = 0.0;
  motion.most_substeps = 32.0;  // what is stiffer runs away, and with it a hypothesis that would hold up all others
  motion.balance_tolerance = 1e-4;
  motion.balance_iterations = 8;
  // Coarser limits made a play of 0.5 mm look like something else on thinned recordings.
  if (!motion.intervals.empty()) {
    const double interval = motion.time.back() / static_cast<double>(motion.intervals.size());
    motion.element_rate_limit = 5.0 / interval;
    motion.followed_rate_limit = 7.0 / interval;
  }
  return motion;
}

Motion screening_motion(Motion motion) {
  motion.step_limit = 2.5;  // the stability limit is 2.78
  motion.finer_at_reversals = 1.0;
  motion.finer_when_long = 0.0;
  motion.most_substeps = 2.0;
  return motion;
}

}  // namespace hysteron
