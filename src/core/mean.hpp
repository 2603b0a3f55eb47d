#pragma once

#include <span>

namespace hysteron {

// Of one value at least.
inline double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace hysteron
