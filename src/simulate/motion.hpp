// A recording's motion prepared for marching: cubic interpolation of displacement and velocity between samples, with
// corners where straight lines meet.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scalar/lanes.hpp"

namespace hysteron {

// Horner in theta with explicit fma: the same bits for a scalar theta and a lane of thetas.
template <class V>
V cubic(const double* c, const V& theta) {
  return fma(fma(fma(V(c[3]), theta, V(c[2])), theta, V(c[1])), theta, V(c[0]));
}

// d/dtheta of it.
template <class V>
V cubic_slope(const double* c, const V& theta) {
  return fma(fma(V(3.0 * c[3]), theta, V(2.0 * c[2])), theta, V(c[1]));
}

// Displacement and velocity as polynomials in theta in [0, 1] over an interval.
struct MotionCourse {
  double x[4];  // Hermite cubic through both displacements with the velocities as slopes
  double v[4];  // cubic through four velocity samples (quadratic slopes at the ends)
};

// From sample n to n + 1.
struct MotionInterval {
  double length;        // s
  MotionCourse course;  // up to a corner, if there is one
  double a[4];          // like course.v through the accelerations
  double middle[4];     // x, v, a and its slope at theta = 1/2
  double end[4];        // at theta = 1, as the polynomials round
  double speed;         // bound of |v| on the interval
  double split_at;      // theta of a reversal or a corner, where a step has to end; 1 without
  bool reversal;        // velocity changes sign
  // On a corner (simulate/corner.hpp) in it or on a sample beside it: the velocity has a jump at split_at, beyond which
  // motion.beyond_corners[corner] holds, and `course` need not have the samples' velocities at its ends.
  int corner;  // -1 without
};

struct Motion {
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  std::vector<double> a;
  std::vector<double> jerk;
  std::vector<double> drive;  // empty: zero
  std::vector<double> load;   // N, force that series elements are taken to bear; empty: that of the model, by balance
  std::vector<MotionInterval> intervals;
  std::vector<MotionCourse> beyond_corners;
  double lead = 0.0;  // s marched before the first sample
  // Largest |lambda| h a sub-step may have: 0.5 at the default tolerance of 1e-4 of peak force.
  double step_limit = 0.5;
  // How much finer the sub-steps are near a velocity reversal: laws that slip against a series element have their kink
  // somewhat before or after it, and where a step straddles it the error is of second order only.
  double finer_at_reversals = 4.0;
  // How much finer the sub-steps of an interval of 5 ms or more are (1 more at 0): a long interval hides kinks that no
  // step lands on, such as the slip or the hysteresis force passing zero, and a coarse recording has few samples.
  double finer_when_long = 3.0;
  double most_substeps = 65536.0;  // of an interval, between two samples
  // Series elements (simulate/assembly.hpp): relative error of the force balance and how many iterations it may take,
  // fastest relaxation in 1/s.
  double balance_tolerance = 1e-11;
  int balance_iterations = 40;
  double element_rate_limit = 5e4;
  // Steps that do not follow the elements (simulate/implicit.hpp).
  bool implicit_elements = false;
  // Whether a march knows the interval after the one that it is in (without_foresight).
  bool foresight = true;
};

// The one that holds on the part of an interval that begins at theta = from.
inline const MotionCourse& course_from(const Motion& motion, const MotionInterval& interval, double from) {
  return interval.corner >= 0 && from >= interval.split_at
             ? motion.beyond_corners[static_cast<std::size_t>(interval.corner)]
             : interval.course;
}

// Slope of the velocity at sample n, m/s^2, which the intervals on both sides have where no corner is near. Not for
// lean motions.
double velocity_slope(const Motion& motion, std::size_t n);

// Arrays of equal length; time strictly increasing (s), displacement (m), velocity (m/s), drive (A or V, may be empty),
// acceleration (m/s^2; empty: the differences of the velocity).
Motion make_motion(std::span<const double> time, std::span<const double> displacement, std::span<const double> velocity,
                   std::span<const double> drive, double tolerance = 1e-4, std::span<const double> acceleration = {});

// As code sees it that is given one sample after the other, beside the damper: no corners, which only later samples
// tell, and whether the velocity changes sign behind an interval is guessed from its slope there. Not for lean motions.
Motion without_foresight(Motion motion);

// For comparing hypotheses with each other, not for forces: kinks between samples are not resolved, and neither is the
// relaxation of series elements that is over between two samples.
Motion comparing_motion(Motion motion);

// For a first look at a candidate: steps as long as stability allows and few of them, so that the cost of a march is
// bounded whatever the parameters. Errors are of the order of 1e-3 of peak force; a parameter set that is too stiff for
// it runs away.
Motion screening_motion(Motion motion);

}  // namespace hysteron
