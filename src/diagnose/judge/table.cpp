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
  double log_odds = score(features, effect);
  if (knots.size() > 1) {
    const double at = std::clamp(log_odds, knots.front().score, knots.back().score);
    std::size_t k = 1;
    while (k + 1 < knots.size() && at > knots[k].score) {
      ++k;
    }
    const Knot& below = knots[k - 1];
    const Knot& above = knots[k];
    log_odds = std::lerp(below.log_odds, above.log_odds, (at - below.score) / (above.score - below.score));
  }
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace hysteron
