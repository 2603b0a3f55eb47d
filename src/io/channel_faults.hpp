// What a channel shows of its own faults, whatever was measured: an end of its range at which it stays, and silence.
// Samples that stand out alone: io/outliers.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hysteron {

// The largest or smallest value of the channel, taken by several samples running, again and again, while next to none
// come near it: the channel ends there. `share` is that of the samples at it.
struct FlatEnd {
  double value = 0.0;
  double share = 0.0;
};
std::optional<FlatEnd> flat_end_of(const std::vector<double>& values);

// The longest stretch of samples that are exactly zero, where it is long and the channel is not zero throughout: a
// logger that pads, or a channel that was off.
struct Silence {
  std::size_t first = 0;  // index of a sample
  std::size_t count = 0;
};
std::optional<Silence> silence_of(const std::vector<double>& values);

}  // namespace hysteron
