// What recordings look like beside each other and over time, told before anything is fitted to them.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

enum class Moving { damper, excitation };

// Remarks on sampling (of motions of a damper), on units and noise beside the other recordings, and on copies.
std::vector<Remark> remarks_on(const std::vector<Recording>& recordings, Moving moving);

}  // namespace hysteron
