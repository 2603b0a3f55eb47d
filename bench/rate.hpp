// A rate as it stands in a page.
#pragma once

#include <fmt/format.h>

#include <string>

#include "challenge/statistics.hpp"

namespace hysteron::bench {

// "3 of 60 (1-14 %)", with the bounds of Clopper and Pearson, 95 %.
inline std::string rate(int hits, int trials) {
  const challenge::Bounds bounds = challenge::clopper_pearson(hits, trials);
  return fmt::format("{} of {} ({:.0f}-{:.0f} %)", hits, trials, 100.0 * bounds.low, 100.0 * bounds.high);
}

}  // namespace hysteron::bench
