// Recordings with fewer samples, for looking at many hypotheses.
#pragma once

#include <cstddef>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Every k-th sample, k the same for all channels of a recording and as large as it takes to keep about `total` samples
// in all, but no larger than leaves a motion from which the left-out samples are recovered by the integrator's own
// interpolation (displacement within 1e-3 of its standard deviation, velocity within 1e-2). Where they are not, because
// the noise of the kept samples of the motion would stand for that of all, the displacement and the recorded velocity
// are those of a cubic fitted to the 2 k + 1 samples around each kept one, and recovered is what is left of the
// recorded ones less their noise. The force stays as recorded, since it is compared with the simulated force of the
// instant.
std::vector<Recording> thinned(const std::vector<Recording>& recordings, std::size_t total);

// At most `count` recordings, spread over drive level and speed.
std::vector<Recording> spread(const std::vector<Recording>& recordings, std::size_t count);

}  // namespace hysteron
