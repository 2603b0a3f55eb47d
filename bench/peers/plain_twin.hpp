// The identification that plain_rk4.h and the program are set the same: Modified Bouc-Wen on a motion of one's own.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bench/peers/plain_rk4.h"
#include "core/random.hpp"
#include "fit/layout.hpp"
#include "fit/score.hpp"

namespace hysteron::peers {

// alpha, c0, c1, k0, k1, x_y, share, n, x0: an MR damper of about 1 kN.
inline const std::vector<double> truth{600.0, 800.0, 3.0e4, 2.0e3, 500.0, 1.2e-3, 0.6, 1.6, 0.0};

// White noise of this share of the peak force.
inline void add_noise(Recording& recording, double share, const Stream& noise) {
  double peak = 0.0;
  for (const double force : recording.force) peak = std::max(peak, std::fabs(force));
  for (std::size_t n = 0; n < recording.size(); ++n) recording.force[n] += share * peak * noise.normal(n);
}

// In the box of `layout`; refers to the samples of `recording`. Throws std::runtime_error where the layout has other
// parameters than plain_rk4.h.
inline plain_problem plain_problem_of(const Recording& recording, const Layout& layout) {
  if (layout.dimension() != plain_dimension) {
    throw std::runtime_error("the model has another number of free parameters than plain_rk4.h");
  }
  plain_problem plain{};
  plain.samples = recording.size();
  plain.time = recording.time.data();
  plain.displacement = recording.displacement.data();
  plain.velocity = recording.velocity.data();
  plain.force = recording.force.data();
  plain.normaliser = normaliser(recording, Normalisation::max_abs);
  for (std::size_t k = 0; k < layout.dimension(); ++k) {
    const Coordinate& coordinate = layout.coordinates()[k];
    plain.lower[k] = coordinate.lower;
    plain.upper[k] = coordinate.upper;
    plain.logarithmic[k] = coordinate.scale == Scale::logarithmic ? 1 : 0;
  }
  return plain;
}

// The truth in unit coordinates.
inline std::vector<double> truth_in(const Layout& layout) {
  std::vector<double> unit;
  for (std::size_t k = 0; k < layout.dimension(); ++k) {
    unit.push_back(layout.unit(k, truth[layout.coordinates()[k].parameter]));
  }
  return unit;
}

}  // namespace hysteron::peers
