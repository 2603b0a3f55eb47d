// Channels that are faulty beside those of the other recordings, whatever their size: cut off at one level in several
// of them, or without a signal in one.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Of a level that one recording alone shows by exactly equal samples it is told where that is read (io/plausible.hpp).
std::vector<Remark> remarks_on_channels_beside_others(const std::vector<Recording>& recordings);

}  // namespace hysteron
