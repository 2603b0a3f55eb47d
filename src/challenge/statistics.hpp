// Rates and their bounds.
#pragma once

#include <vector>

namespace hysteron::challenge {

struct Bounds {
  double low;
  double high;
};

// Two-sided bounds of Clopper and Pearson for `hits` of `trials` at the given confidence, by bisection on the exact
// binomial tails. [0, 1] when there are no trials.
// Source: Clopper, Pearson, Biometrika 26 (1934) 404-413, doi 10.1093/biomet/26.4.404.
[[nodiscard]] Bounds clopper_pearson(int hits, int trials, double confidence = 0.95);

// Lower median; NaN when empty.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace hysteron::challenge
