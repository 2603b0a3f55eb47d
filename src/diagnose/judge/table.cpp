#include "diagnose/judge/table.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {

double Table::score(std::span<const double> features, std::string_view effect) const {
  const auto offset = std::ranges::find(offsets, effect, &Offset::effect);
  double sum = intercept + (offset == offsets.end() ? 0.0 : offset->value);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    sum += weights[k] * features[k];
  }
  return sum;
}

double Table::probability(std::span<const double> features, std::string_view effect) const {
  const double at = score(features, effect);
  if (knots.empty()) {
    return 1.0 / (1.0 + std::exp(-at));
  }
  if (at <= knots.front().score) {
    return knots.front().probability;
  }
  for (std::size_t k = 1; k < knots.size(); ++k) {
    if (at <= knots[k].score) {
      const double width = knots[k].score - knots[k - 1].score;
      const double part = width > 0.0 ? (at - knots[k - 1].score) / width : 1.0;
      return knots[k - 1].probability + part * (knots[k].probability - knots[k - 1].probability);
    }
  }
  return knots.back().probability;
}

}  // namespace hysteron
