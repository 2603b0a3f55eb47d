// Middle and spread of numbers that a few of them cannot shift.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace hysteron {

// The upper one of the two in the middle; at least one value.
inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Standard deviation about `centre` of values that are normal but for a few: their median distance from it, over that
// of the standard normal. At least one value.
inline double robust_deviation(std::vector<double> values, double centre = 0.0) {
  constexpr double normal = 1.4826;
  std::ranges::transform(values, values.begin(), [centre](double value) { return std::fabs(value - centre); });
  return normal * median_of(std::move(values));
}

}  // namespace hysteron
