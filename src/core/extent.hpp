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

// The smaller of how far the values rise and how far they fall, between any two of them in their order: 0 where they
// only rise, or only fall.
inline double turned_by(std::span<const double> values) {
  if (values.empty()) {
    return 0.0;
  }
  double low = values.front();
  double high = values.front();
  double rise = 0.0;
  double fall = 0.0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
    rise = std::max(rise, value - low);
    fall = std::max(fall, high - value);
  }
  return std::min(rise, fall);
}

}  // namespace hysteron
