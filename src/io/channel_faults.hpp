// What a channel shows of its own faults, whatever was measured: samples that stand out alone, and an end of its range
// at which it stays.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hysteron {

// Samples far beyond all others, each by itself or with one beside it. `usual`: what 99 % of the samples stay below, as
// a distance from the median.
struct Outliers {
  std::size_t count = 0;
  std::size_t furthest = 0;  // index of a sample
  double usual = 0.0;
};
std::optional<Outliers> outliers_of(const std::vector<double>& values);

// The largest or smallest value of the channel, taken by several samples running, again and again, while next to none
// come near it: the channel ends there. `share` is that of the samples at it.
struct FlatEnd {
  double value = 0.0;
  double share = 0.0;
};
std::optional<FlatEnd> flat_end_of(const std::vector<double>& values);

// The longest stretch of samples that are exactly zero, where it is long and the channel is not zero throughout: a logger
// that pads, or a channel that was off.
struct Silence {
  std::size_t first = 0;  // index of a sample
  std::size_t count = 0;
};
std::optional<Silence> silence_of(const std::vector<double>& values);

}  // namespace hysteron
