#include "diagnose/search/valleys.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr double other_valley = 0.5;  // of the box

}  // namespace

std::vector<std::vector<double>> in_several_valleys(std::vector<std::vector<double>> sorted,
                                                    const std::vector<bool>& projected, std::size_t most) {
  const auto distance = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double result = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c) {
      result = projected[c] ? result : std::max(result, std::fabs(a[c] - b[c]));
    }
    return result;
  };
  std::vector<std::vector<double>> result;
  while (result.size() < most && !sorted.empty()) {
    const auto is_elsewhere = [&](const std::vector<double>& start) {
      return std::ranges::all_of(
          result, [&](const std::vector<double>& taken) { return distance(start, taken) >= other_valley; });
    };
    auto next = std::ranges::find_if(sorted, is_elsewhere);
    next = next == sorted.end() ? sorted.begin() : next;
    result.push_back(std::move(*next));
    sorted.erase(next);
  }
  return result;
}

}  // namespace hysteron
