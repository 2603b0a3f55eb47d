// At how many values of the drive a device was recorded.
#pragma once

#include <cstddef>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// count_levels() of all recordings: of a recording in which the drive is constant its mean counts, else every sample. 0
// where none has a drive.
std::size_t drive_levels(const std::vector<Recording>& recordings);

}  // namespace hysteron
