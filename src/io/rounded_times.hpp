// Times of an even sampling that were rounded to the last digit of their stamps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/channels.hpp"

namespace hysteron {

// Steps of two sizes, one resolution apart, that stay within it of an even grid, over which the displacement goes as
// far over the longer ones as over the shorter: 2 and 3 ms where 400 Hz are stamped in milliseconds. Where the steps
// are real the motion goes on during them.
struct RoundedTimes {
  double resolution = 0.0;  // s
  double step = 0.0;        // s, of the even sampling
  double start = 0.0;       // s
};
std::optional<RoundedTimes> rounded_times_of(const std::vector<double>& time, const std::vector<double>& displacement);

// Where the times are rounded so, takes the samples as evenly spaced and tells `options.remark`.
void even_out_rounded_times(Channels& channels, const ReadOptions& options, const std::string& file);

}  // namespace hysteron
