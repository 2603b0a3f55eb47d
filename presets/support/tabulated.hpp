// Values printed for 0, 0.25, 0.5, 0.75 and 1 A, linear in between and held outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace hysteron {

inline double tabulated(double current, const std::array<double, 5>& values) {
  const double position = 4.0 * std::clamp(current, 0.0, 1.0);
  const auto below = std::min<std::size_t>(3, static_cast<std::size_t>(position));
  const double share = position - static_cast<double>(below);
  return (1.0 - share) * values[below] + share * values[below + 1];
}

}  // namespace hysteron
