// How far the values of a channel reach.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace hysteron {

// The largest size of a value; 0 without values.
inline double peak_of(std::span<const double> values) {
  double result = 0.0;
  for (const double value : values) {
    result = std::max(result, std::fabs(value));
  }
  return result;
}

// Largest less smallest value; 0 without values.
inline double span_of(std::span<const double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto [low, high] = std::ranges::minmax(values);
  return high - low;
}

}  // namespace hysteron
