// Candidates drawn from the boxes of a model's cards.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "simulate/composite.hpp"

namespace hysteron::bench {

// Parameters in the order of the cards: uniform over the box, of those on a logarithmic scale over its logarithm; what
// is fixed at its initial value.
inline std::vector<double> drawn(const CompositeModel& model, const Stream& stream) {
  std::vector<double> p;
  std::uint32_t j = 0;
  for (const Parameter& card : model.parameters()) {
    const double u = stream.uniform(0, j++);
    p.push_back(card.fixed                         ? card.initial
                : card.scale == Scale::logarithmic ? card.box.lower * std::pow(card.box.upper / card.box.lower, u)
                                                   : card.box.lower + u * (card.box.upper - card.box.lower));
  }
  return p;
}

}  // namespace hysteron::bench
