// A channel that lost its sign.
#pragma once

#include "core/recording.hpp"

namespace hysteron {

// Whether the force is never below zero and turns up again by a kink wherever it comes down to it, as a force without
// its sign does. What comes to zero and stays, or turns round there gently, has its sign.
bool force_is_rectified(const Recording& recording);

// Likewise of the displacement: the force goes on through the kinks of a displacement without its sign, and turns with
// those of a ramp.
bool displacement_is_rectified(const Recording& recording);

}  // namespace hysteron
