// Order statistics of a sample.
#pragma once

#include <vector>

namespace hysteron {

// Quantile of a non-empty sample by linear interpolation between order statistics (type 7 of Hyndman and Fan 1996):
// position (n - 1) p. Infinite values are allowed; a quantile between a finite and an infinite one is infinite.
[[nodiscard]] double quantile(std::vector<double> sample, double p);

struct Quartiles {
  double lower;
  double median;
  double upper;
};
[[nodiscard]] Quartiles quartiles(const std::vector<double>& sample);

}  // namespace hysteron
