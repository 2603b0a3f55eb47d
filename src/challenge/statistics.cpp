#include "challenge/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron::challenge {
namespace {

// P(X <= k) for X binomial(n, p), 0 < p < 1.
double at_most(int k, int n, double p) {
  double sum = 0.0;
  double log_term = n * std::log1p(-p);
  const double log_odds = std::log(p) - std::log1p(-p);
  for (int j = 0; j <= k; ++j) {
    sum += std::exp(log_term);
    log_term += std::log((n - j) / (j + 1.0)) + log_odds;
  }
  return std::min(sum, 1.0);
}

// The p at which a tail that falls with p has the wanted value.
template <class Tail>
double solve(const Tail& falling, double wanted) {
  double low = 0.0;
  double high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Bounds clopper_pearson(int hits, int trials, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  if (trials <= 0) return {0.0, 1.0};
  Bounds bounds{0.0, 1.0};
  if (hits > 0) bounds.low = solve([&](double p) { return at_most(hits - 1, trials, p); }, 1.0 - tail);
  if (hits < trials) bounds.high = solve([&](double p) { return at_most(hits, trials, p); }, tail);
  return bounds;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace hysteron::challenge
