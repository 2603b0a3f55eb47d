// A recording among others of a campaign whose unit or zero is another: seen alone, it may well be of a damper.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Remarks of recordings of which one channel (displacement, time, force or drive), a thousand times as large or as
// small, has the figures of most others, and as it is has not: metres among millimetres, microseconds among
// milliseconds. And of one that lies far from where the rod was in all others, of units of displacement and force that
// are wrong together, and of a drive of the other sign.
std::vector<Remark> remarks_beside_others(const std::vector<Recording>& recordings);

}  // namespace hysteron
