// What a sample of a smooth channel differs by from its neighbours.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace hysteron {

// Samples on each side that the quintic goes through.
inline constexpr std::size_t quintic_reach = 3;

// By how much sample i, with three on each side, differs from the quintic through these six, over the root of what it
// passes on of independent noise of variance 1: of noise alone it has the variance of that. Time strictly increasing.
inline double off_neighbours(std::span<const double> time, std::span<const double> samples, std::size_t i) {
  double difference = 0.0;
  double variance = 1.0;
  for (std::size_t k = i - quintic_reach; k <= i + quintic_reach; ++k) {
    if (k == i) continue;
    double weight = 1.0;
    for (std::size_t m = i - quintic_reach; m <= i + quintic_reach; ++m) {
      if (m != i && m != k) weight *= (time[i] - time[m]) / (time[k] - time[m]);
    }
    difference += weight * (samples[k] - samples[i]);
    variance += weight * weight;
  }
  return std::abs(difference) / std::sqrt(variance);
}

}  // namespace hysteron
