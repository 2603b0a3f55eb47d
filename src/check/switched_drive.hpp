// Drives that move too fast to be told from noise, and so count as constant (core/drive.hpp).
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// A remark on each recording whose drive goes between levels from sample to sample, by a quarter or more of the largest
// drive of all recordings: it is simulated at its mean.
std::vector<Remark> remarks_on_switched_drives(const std::vector<Recording>& recordings);

}  // namespace hysteron
