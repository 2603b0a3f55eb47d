#include "core/interval_text.hpp"

#include <limits>

namespace hysteron {

std::pair<std::string, std::string> interval_ends(double low, double high, int fewest,
                                                  const std::function<std::string(double value, int digits)>& text) {
  int digits = fewest;
  if (low < high) {
    while (digits < std::numeric_limits<double>::max_digits10 && text(low, digits) == text(high, digits)) ++digits;
  }
  return {text(low, digits), text(high, digits)};
}

}  // namespace hysteron
