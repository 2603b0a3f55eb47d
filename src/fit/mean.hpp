#pragma once

#include <vector>

namespace hysteron {

// Of one value at least.
inline double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace hysteron
