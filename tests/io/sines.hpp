// Tests of one frequency and rising stroke.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron::testing {

// Four sines of 1 Hz at 200 Hz, of amplitudes `first`, `first` + `more`, ... in m; r1.csv and so on, without a force.
inline std::vector<Recording> four_sines(std::size_t samples, double first, double more) {
  std::vector<Recording> result;
  for (int k = 0; k < 4; ++k) {
    Recording one;
    one.file = "r" + std::to_string(k + 1) + ".csv";
    const double amplitude = first + more * k;
    for (std::size_t n = 0; n < samples; ++n) {
      const double phase = 0.01 * std::numbers::pi * static_cast<double>(n);
      one.time.push_back(0.005 * static_cast<double>(n));
      one.displacement.push_back(amplitude * std::sin(phase));
      one.velocity.push_back(2.0 * std::numbers::pi * amplitude * std::cos(phase));
    }
    result.push_back(one);
  }
  return result;
}

}  // namespace hysteron::testing
