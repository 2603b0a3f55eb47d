// A recording's motion prepared for marching: cubic interpolation of displacement and velocity between samples.
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

// Polynomials in theta in [0, 1] over the interval from sample n to n + 1.
struct MotionInterval {
  double length;    // s
  double x[4];      // Hermite cubic through both displacements with the velocities as slopes
  double v[4];      // cubic through four velocity samples (quadratic slopes at the ends)
  double middle[2];  // x and v at theta = 1/2
  double end[2];     // x and v at theta = 1, as the polynomials round
  double speed;     // bound of |v| on the interval
  bool reversal;    // velocity changes sign
  double reversal_at;  // theta of the change
};

struct Motion {
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  std::vector<double> drive;  // empty: zero
  std::vector<MotionInterval> intervals;
  // Largest |lambda| h a sub-step may have: 0.5 at the default tolerance of 1e-4 of peak force.
  double step_limit = 0.5;
};

// Arrays of equal length; time strictly increasing (s), displacement (m), velocity (m/s), drive (A or V, may be empty).
Motion make_motion(std::span<const double> time, std::span<const double> displacement,
                   std::span<const double> velocity, std::span<const double> drive, double tolerance = 1e-4);

}  // namespace hysteron
