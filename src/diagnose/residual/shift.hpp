// Shifts of a residual against the motion, for what a bond between the two would be by chance.
#pragma once

#include <cmath>
#include <cstddef>

namespace hysteron {

// Of `size` samples, the `number`-th shift: 0 for the first, then shifts that stay away from none at all and, by the
// golden section, from the multiples of a period. `phase` in cycles sets recordings apart that are shifted together.
inline std::size_t shift_of(std::size_t number, std::size_t size, double phase = 0.0) {
  const double part = std::fmod(0.6180339887498949 * static_cast<double>(number) + phase, 1.0);
  return number == 0 ? 0 : static_cast<std::size_t>((0.08 + 0.84 * part) * static_cast<double>(size));
}

}  // namespace hysteron
