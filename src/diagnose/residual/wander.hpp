// Misfit that follows the force by a factor which changes with time: of a supply that cycles, of a rig whose grip
// changes. It repeats with nothing of the motion, so that it looks like coloured noise, and where cycles of the motion
// are compared it counts as noise; that it follows the force tells it from noise.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// What is left of one recording, without its run-in: arrays of equal length.
struct Leftover {
  std::vector<double> time;      // s, increasing
  std::vector<double> residual;  // in any unit, one for all recordings
  std::vector<double> force;     // in any unit, predicted
};

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

// `norms`: N, what the force of each recording is divided by.
std::vector<Leftover> leftovers_of(const std::vector<Recording>& recordings, const std::vector<Residual>& residuals,
                                   const std::vector<double>& norms);

}  // namespace hysteron
