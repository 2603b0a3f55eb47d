// A channel that is cut off behind its noise: at an end of its range it has exactly one value, again and again, where
// it has noise everywhere else. One whose noise comes from behind what cuts it off: io/clipped_ends.hpp.
#pragma once

#include <optional>
#include <vector>

#include "core/recording.hpp"
#include "io/channel_faults.hpp"

namespace hysteron {

// The largest value of the channel (`sign` 1) or the smallest one (-1), where many samples are exactly at it, many more
// than at any other value, and the channel is noisy between its ends. What has noise does not rest without any: nothing
// is told of a force without noise, which yields at exactly one value too, nor of one in coarse steps.
std::optional<FlatEnd> saturated_end_of(const std::vector<double>& values, double sign);

// Whether the noise of the force is that of displacement and velocity, as of a force that was simulated on a motion
// that was measured: it yields at exactly one value too.
bool force_noise_is_of_motion(const Recording& recording);

// Both ends of the force, where neither its noise is that of the motion nor its value one that stands for no sample.
std::vector<FlatEnd> saturated_ends_of_force(const Recording& recording);

}  // namespace hysteron
