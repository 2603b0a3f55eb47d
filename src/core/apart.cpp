#include "core/apart.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr std::size_t fewest = 3;

RodStretch of_others(const std::vector<RodStretch>& all, std::size_t one) {
  RodStretch result = all[one == 0 ? 1 : 0];
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == one) continue;
    result.low = std::min(result.low, all[k].low);
    result.high = std::max(result.high, all[k].high);
  }
  return result;
}

}  // namespace

std::vector<Apart> apart_from_others(const std::vector<Recording>& recordings) {
  if (recordings.size() < fewest) return {};
  std::vector<RodStretch> all;
  for (const Recording& recording : recordings) {
    if (recording.displacement.empty()) return {};
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    all.push_back({low, high});
  }
  std::vector<Apart> result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const RodStretch others = of_others(all, k);
    const double covered = others.high - others.low;
    const double gap = std::max(all[k].low - others.high, others.low - all[k].high);
    if (covered > 0.0 && gap > covered) result.push_back({k, all[k], others});
  }
  return result;
}

}  // namespace hysteron
