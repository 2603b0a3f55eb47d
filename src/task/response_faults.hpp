// What recordings of the motion of a mass on a damper show of faults that the reader of a damper's recordings does not
// look for, since they are of the mass.
#pragma once

#include <vector>

#include "io/channels.hpp"
#include "respond/refine.hpp"
#include "simulate/composite.hpp"

namespace hysteron {

// Leaves out what comes before a release, and an acceleration that is not that of the mass relative to its base;
// remarks on both, and on forces and a mass that do not go with the motion.
std::vector<Remark> mend_responses(std::vector<Recording>& responses, const Rig& rig);

// Free decays that come to rest in different places, of which the model knows one.
std::vector<Remark> places_of_rest(const std::vector<Recording>& responses, const Rig& rig,
                                   const CompositeModel& model);

}  // namespace hysteron
