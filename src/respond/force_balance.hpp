// The forces of a recorded motion of a mass against one another, before anything is identified: which of them cannot be
// what they are taken for.
#pragma once

#include <optional>

#include "core/recording.hpp"
#include "respond/refine.hpp"

namespace hysteron {

// Whether the recorded force is the one that a damper has in a free decay, -(m x'' + C x' + K x), and so nothing that
// acts on the mass. Else that is so only of a damper whose force is twice that which excites it, at all times.
bool is_of_damper(const Recording& recording, const Rig& rig);

// m x'' over all that is known to act on the mass beside the damper: a force, spring and dashpot. Nothing where none of
// them is, or where the displacement does not tell the acceleration.
std::optional<double> inertia_over_known(const Recording& recording, const Rig& rig);

}  // namespace hysteron
