// Recordings with fewer samples, for looking at many hypotheses.
#pragma once

#include <cstddef>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Every k-th sample, k the same for all channels of a recording and as large as it takes to keep about `total` samples
// in all, but no larger than leaves a motion from which the left-out samples are recovered by the integrator's own
// interpolation (displacement within 1e-3 of its standard deviation, velocity within 1e-2).
std::vector<Recording> thinned(const std::vector<Recording>& recordings, std::size_t total);

// At most `count` recordings, spread over drive level and speed.
std::vector<Recording> spread(const std::vector<Recording>& recordings, std::size_t count);

}  // namespace hysteron
