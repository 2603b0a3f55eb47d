#include "core/probability_text.hpp"

#include <cmath>

namespace hysteron {

std::string probability_text(double probability) {
  // What was written as a decimal number, 0.95, counts as it reads.
  constexpr double rounding = 1e-9;
  const double percent = 100.0 * probability;
  return percent > 99.0 + rounding && probability < 1.0
             ? "over 99 %"
             : std::to_string(static_cast<int>(std::floor(percent + rounding))) + " %";
}

}  // namespace hysteron
