#include "study/proportion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hysteron {

Interval wilson(std::size_t successes, std::size_t trials, double z) {
  assert(trials > 0 && successes <= trials);
  const auto k = static_cast<double>(successes);
  const auto n = static_cast<double>(trials);
  const double centre = k + 0.5 * z * z;
  const double half = z * std::sqrt(k * (n - k) / n + 0.25 * z * z);
  return {std::max(0.0, (centre - half) / (n + z * z)), std::min(1.0, (centre + half) / (n + z * z))};
}

}  // namespace hysteron
