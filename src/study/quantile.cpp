#include "study/quantile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace hysteron {
namespace {

double of_sorted(const std::vector<double>& sorted, double p) {
  const double position = static_cast<double>(sorted.size() - 1) * p;
  const double below = std::floor(position);
  const auto k = static_cast<std::size_t>(below);
  const double share = position - below;
  if (share == 0.0) return sorted[k];
  // Written as a weighted sum so that infinity minus infinity cannot occur.
  return (1.0 - share) * sorted[k] + share * sorted[k + 1];
}

}  // namespace

double quantile(std::vector<double> sample, double p) {
  assert(!sample.empty() && p >= 0.0 && p <= 1.0);
  std::ranges::sort(sample);
  return of_sorted(sample, p);
}

Quartiles quartiles(const std::vector<double>& sample) {
  std::vector<double> sorted = sample;
  std::ranges::sort(sorted);
  return {of_sorted(sorted, 0.25), of_sorted(sorted, 0.5), of_sorted(sorted, 0.75)};
}

}  // namespace hysteron
