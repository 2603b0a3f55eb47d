// Misfit that follows the force by a factor which changes from stretch to stretch of a recording: of a supply that
// cycles, of a rig whose grip changes. It repeats with nothing of the motion, so that it looks like coloured noise;
// that it follows the force tells it from noise.
#pragma once

#include "diagnose/workbench.hpp"

namespace hysteron {

struct Wandering {
  double share = 0.0;      // of the squared residual that such a factor takes off the fitted recordings
  double by_chance = 0.0;  // the most it takes off a residual shifted against the force
};

Wandering wandering(const Workbench& bench, const Fit& fit);
// Whether chance does not explain the share.
bool wanders(const Wandering& wandering);

}  // namespace hysteron
