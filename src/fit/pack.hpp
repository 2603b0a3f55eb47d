// Candidates side by side in the lanes of a pack.
#pragma once

#include <span>
#include <vector>

#include "fit/layout.hpp"
#include "simulate/part.hpp"

namespace hysteron {

// A pack of candidates: their rows in the request, at most one a lane.
using Rows = std::span<const std::size_t>;

// Lanes of coordinate c: physical values, or their slopes with the unit coordinate. Lane l holds candidate of(l).
template <class P = Lanes, class Of>
P lanes_of(const std::vector<double>& points, Rows rows, const Layout& layout, std::size_t c, bool slope, Of&& of) {
  P result;
  for (int lane = 0; lane < P::lanes; ++lane) {
    const double u = points[rows[of(static_cast<std::size_t>(lane))] * layout.dimension() + c];
    result.set_lane(lane, slope ? layout.slope(c, u) : layout.physical(c, u));
  }
  return result;
}

// Parameters of a pack at one drive level and values of the conditions: nodes weighted by the law. For duals, the
// directions of this sweep are the coordinates [sweep, sweep + sweep_directions).
template <class T, class Drive>
void parameters_of_pack(const Layout& layout, const std::vector<T>& nodes, const Drive& drive, double frequency,
                        std::span<const double> conditions, T* p) {
  for (std::size_t j = 0; j < layout.cards().size(); ++j) {
    p[j] = T(layout.held()[j]);
  }
  for (const ParameterLaw& law : layout.laws()) {
    const std::vector<Drive> weights = Layout::weights<Drive>(law, drive, frequency, conditions);
    T value = T(weights[0]) * nodes[law.first];
    for (std::size_t k = 1; k < weights.size(); ++k) {
      value = fma(T(weights[k]), nodes[law.first + k], value);
    }
    p[law.parameter] = weights.size() == 1 ? nodes[law.first] : value;
  }
}

}  // namespace hysteron
