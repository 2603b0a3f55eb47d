// Success rates with the interval that small samples need.
#pragma once

#include <cstddef>

#include "core/interval.hpp"

namespace hysteron {

// Wilson score interval for k successes in n > 0 trials (Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212), z = 1.96 for
// 95 %:  (k + z^2/2 +- z sqrt(k (n - k) / n + z^2/4)) / (n + z^2).
[[nodiscard]] Interval wilson(std::size_t successes, std::size_t trials, double z = 1.959963984540054);

}  // namespace hysteron
