#include "core/midranks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace hysteron {

std::vector<double> midranks(const std::vector<double>& values, double tie) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    const double first = values[order[begin]];
    const double reach = std::isfinite(first) ? first + tie * std::fabs(first) : first;
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] <= reach) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t k = begin; k < end; ++k) ranks[order[k]] = rank;
    begin = end;
  }
  return ranks;
}

}  // namespace hysteron
