#include <algorithm>
#include <cmath>
#include <optional>

#include "simulate/corner.hpp"
#include "simulate/lean_motion.hpp"

namespace hysteron {
namespace {

// Slope of the interpolant at sample k: three-point differences on the non-uniform grid.
double slope_at(std::span<const double> t, std::span<const double> y, std::size_t k) {
  const std::size_t n = t.size();
  if (n < 3) {
    return n == 2 ? (y[1] - y[0]) / (t[1] - t[0]) : 0.0;
  }
  if (k == 0) {
    return 2.0 * (y[1] - y[0]) / (t[1] - t[0]) - slope_at(t, y, 1);
  }
  if (k + 1 == n) {
    return 2.0 * (y[n - 1] - y[n - 2]) / (t[n - 1] - t[n - 2]) - slope_at(t, y, n - 2);
  }
  const double left = t[k] - t[k - 1];
  const double right = t[k + 1] - t[k];
  return ((y[k] - y[k - 1]) / left * right + (y[k + 1] - y[k]) / right * left) / (left + right);
}

std::vector<double> slopes(std::span<const double> t, std::span<const double> y, std::size_t first, std::size_t last) {
  std::vector<double> slope(last - first);
  for (std::size_t k = first; k < last; ++k) {
    slope[k - first] = slope_at(t, y, k);
  }
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

namespace {

Motion samples_of(std::span<const double> time, std::span<const double> displacement, std::span<const double> velocity,
                  std::span<const double> drive, double tolerance, std::span<const double> acceleration) {
  Motion motion;
  // Parts count time from the start of the recording.
  motion.time.reserve(time.size());
  for (const double t : time) {
    motion.time.push_back(t - time[0]);
  }
  motion.x.assign(displacement.begin(), displacement.end());
  motion.v.assign(velocity.begin(), velocity.end());
  motion.drive.assign(drive.begin(), drive.end());
  motion.step_limit = 0.5 * std::min(2.0, std::pow(tolerance / 1e-4, 0.25));
  motion.a = acceleration.empty() ? slopes(time, velocity, 0, time.size())
                                  : std::vector<double>(acceleration.begin(), acceleration.end());
  return motion;
}

// The samples first to last of all those that a motion is made of; the ones around them tell corners.
struct Samples {
  std::span<const double> time;
  std::span<const double> displacement;
  std::span<const double> velocity;
  std::size_t first;
  std::size_t last;
};

// Bound of the speed along an interval: a Hermite cubic stays within its end values plus 4/27 of h |slope| of either.
double fastest(double length, double start, double end, double start_slope, double end_slope) {
  return std::max(std::fabs(start), std::fabs(end)) +
         4.0 / 27.0 * length * (std::fabs(start_slope) + std::fabs(end_slope));
}

// Straight lines of the velocity on both sides of a corner, in theta; the displacements are those of the samples.
void turn(const VelocityCorner& corner, double x0, double x1, MotionInterval& interval,
          std::vector<MotionCourse>& beyond_corners) {
  const double h = interval.length;
  const double bend0 = 0.5 * h * h * corner.start_slope;
  const double bend1 = 0.5 * h * h * corner.end_slope;
  interval.course = {.x = {x0, h * corner.start, bend0, 0.0}, .v = {corner.start, h * corner.start_slope, 0.0, 0.0}};
  const MotionCourse beyond = {.x = {x1 - h * corner.end + bend1, h * corner.end - 2.0 * bend1, bend1, 0.0},
                               .v = {corner.end - h * corner.end_slope, h * corner.end_slope, 0.0, 0.0}};
  interval.corner = static_cast<int>(beyond_corners.size());
  beyond_corners.push_back(beyond);
  interval.split_at = corner.at;
  interval.speed = fastest(h, corner.start, corner.end, corner.start_slope, corner.end_slope);
  const double before = cubic(interval.course.v, corner.at);
  const double after = cubic(beyond.v, corner.at);
  interval.reversal = before * after < 0.0;
}

// Without a corner; slopes of the velocity at both ends.
void go_smoothly(double x0, double x1, double v0, double v1, double slope0, double slope1, MotionInterval& interval) {
  hermite(interval.length, x0, x1, v0, v1, interval.course.x);
  hermite(interval.length, v0, v1, slope0, slope1, interval.course.v);
  interval.corner = -1;
  interval.speed = fastest(interval.length, v0, v1, slope0, slope1);
  interval.reversal = v0 * v1 < 0.0;
  interval.split_at = interval.reversal ? zero_crossing(interval.course.v) : 1.0;
}

// The intervals between samples first to last of all, which are those of `motion`.
void add_intervals(const Samples& all, Motion& motion) {
  const std::vector<double> slope = slopes(all.time, all.velocity, all.first, all.last);
  const auto corner_at = [&](std::size_t n) {
    return motion.foresight && n + 1 < all.time.size() ? corner_of(all.time, all.displacement, all.velocity, n)
                                                       : std::nullopt;
  };
  motion.intervals.resize(all.last > all.first ? all.last - all.first - 1 : 0);
  motion.beyond_corners.clear();
  if (motion.intervals.empty()) return;
  const auto slope_behind = [](const std::optional<VelocityCorner>& corner, double smooth) {
    return corner ? corner->end_slope : smooth;
  };
  double start_slope = all.first > 0 ? slope_behind(corner_at(all.first - 1), slope[0]) : slope[0];
  std::optional<VelocityCorner> here = corner_at(all.first);
  for (std::size_t n = 0; n < motion.intervals.size(); ++n) {
    MotionInterval& interval = motion.intervals[n];
    const std::optional<VelocityCorner> next = corner_at(all.first + n + 1);
    interval.length = motion.time[n + 1] - motion.time[n];
    if (here.has_value()) {
      turn(*here, motion.x[n], motion.x[n + 1], interval, motion.beyond_corners);
    } else {
      go_smoothly(motion.x[n], motion.x[n + 1], motion.v[n], motion.v[n + 1], start_slope,
                  next ? next->start_slope : slope[n + 1], interval);
    }
    hermite(interval.length, motion.a[n], motion.a[n + 1], motion.jerk[n], motion.jerk[n + 1], interval.a);
    interval.middle[0] = cubic(interval.course.x, 0.5);
    interval.middle[1] = cubic(interval.course.v, 0.5);
    interval.middle[2] = cubic(interval.a, 0.5);
    interval.middle[3] = cubic_slope(interval.a, 0.5) / interval.length;
    interval.end[0] = cubic(interval.course.x, 1.0);
    interval.end[1] = cubic(interval.course.v, 1.0);
    interval.end[2] = cubic(interval.a, 1.0);
    interval.end[3] = cubic_slope(interval.a, 1.0) / interval.length;
    start_slope = slope_behind(here, slope[n + 1]);
    here = next;
  }
}

}  // namespace

double velocity_slope(const Motion& motion, std::size_t n) {
  if (n < motion.intervals.size()) return motion.intervals[n].course.v[1] / motion.intervals[n].length;
  if (n == 0) return 0.0;
  return cubic_slope(motion.intervals[n - 1].course.v, 1.0) / motion.intervals[n - 1].length;
}

Motion make_motion(std::span<const double> time, std::span<const double> displacement, std::span<const double> velocity,
                   std::span<const double> drive, double tolerance, std::span<const double> acceleration) {
  Motion motion = samples_of(time, displacement, velocity, drive, tolerance, acceleration);
  motion.jerk = slopes(time, motion.a, 0, time.size());
  add_intervals({motion.time, motion.x, motion.v, 0, time.size()}, motion);
  return motion;
}

void copy_settings(const Motion& from, Motion& to) {
  to.lead = from.lead;
  to.step_limit = from.step_limit;
  to.finer_at_reversals = from.finer_at_reversals;
  to.finer_when_long = from.finer_when_long;
  to.most_substeps = from.most_substeps;
  to.balance_tolerance = from.balance_tolerance;
  to.balance_iterations = from.balance_iterations;
  to.element_rate_limit = from.element_rate_limit;
  to.implicit_elements = from.implicit_elements;
  to.foresight = from.foresight;
}

Motion make_lean_motion(std::span<const double> time, std::span<const double> displacement,
                        std::span<const double> velocity, std::span<const double> drive, double tolerance,
                        std::span<const double> acceleration) {
  return samples_of(time, displacement, velocity, drive, tolerance, acceleration);
}

void prepare(const Motion& lean, std::size_t first, std::size_t last, Motion& piece) {
  copy_settings(lean, piece);
  const auto part = [&](const std::vector<double>& from, std::vector<double>& to) {
    if (from.empty()) {
      to.clear();
    } else {
      to.assign(from.begin() + static_cast<std::ptrdiff_t>(first), from.begin() + static_cast<std::ptrdiff_t>(last));
    }
  };
  part(lean.time, piece.time);
  part(lean.x, piece.x);
  part(lean.v, piece.v);
  part(lean.a, piece.a);
  part(lean.drive, piece.drive);
  part(lean.load, piece.load);
  piece.jerk = slopes(lean.time, lean.a, first, last);
  add_intervals({lean.time, lean.x, lean.v, first, last}, piece);
}

Motion without_foresight(Motion motion) {
  motion.foresight = false;
  add_intervals({motion.time, motion.x, motion.v, 0, motion.time.size()}, motion);
  return motion;
}

namespace {

void balance_coarsely(Motion& motion) {
  motion.balance_tolerance = 1e-4;
  motion.balance_iterations = 8;
  motion.implicit_elements = true;
}

}  // namespace

Motion comparing_motion(Motion motion) {
  motion.step_limit = 1.5;
  motion.finer_at_reversals = 1.0;
  motion.finer_when_long = 0.0;
  motion.most_substeps = 32.0;  // what is stiffer runs away, and with it a hypothesis that would hold up all others
  balance_coarsely(motion);
  return motion;
}

Motion screening_motion(Motion motion) {
  motion.step_limit = 2.5;  // the stability limit is 2.78
  motion.finer_at_reversals = 1.0;
  motion.finer_when_long = 0.0;
  motion.most_substeps = 2.0;
  balance_coarsely(motion);
  return motion;
}

}  // namespace hysteron
