// Misfit that follows the force by a factor which changes with time: of a supply that cycles, of a rig whose grip
// changes. It repeats with nothing of the motion, so that it looks like coloured noise, and where cycles of the motion
// are compared it counts as noise; that it follows the force tells it from noise.
#pragma once

#include <vector>

#include "diagnose/residual/leftover.hpp"

namespace hysteron {

struct Wandering {
  double share = 0.0;      // of the squared residual that such a factor takes off all recordings together
  double by_chance = 0.0;  // what it takes off with the force of another instant, when that is not alike
  double period = 0.0;     // s, of a factor that cycles; 0 where it changes in no such way
};

// Of a factor that swings as a sine of the same period in all recordings, or, where only that is more than chance, of
// one that changes from stretch to stretch.
Wandering wandering(const std::vector<Leftover>& leftovers);
// Whether chance does not explain the share.
bool wanders(const Wandering& wandering);

}  // namespace hysteron
