// Where a mass comes to rest after a free decay.
#pragma once

#include <optional>

#include "core/recording.hpp"

namespace hysteron {

struct RestLevel {
  double level;    // m
  double noise;    // m, standard deviation of a sample
  double largest;  // m, distance from it
  // m: it still swung to both sides of the level within this distance from it. A friction that holds the mass off its
  // equilibrium by d leaves its last two turns 2 d apart or more.
  double last_swings;
};

// Nothing where it still moves in the last eighth of the recording.
std::optional<RestLevel> rest_level_of(const Recording& recording);

}  // namespace hysteron
