// A load cell that was not connected, seen beside the recordings in which it was.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// A force that follows nothing of the motion, and is a tenth at most of what the weakest of the other recordings would
// have at its speed.
struct DeadForce {
  std::size_t recording = 0;
  double rms = 0.0;       // N, about its mean
  double expected = 0.0;  // N, by the weakest of the others
};
// Nothing where most recordings are like that, or of a stroke that is shorter than those of all others: a play is.
std::vector<DeadForce> dead_forces_of(const std::vector<Recording>& recordings);

// "r2.csv: the force follows nothing of the motion ...", without a full stop.
std::string sentence_of(const DeadForce& dead);

}  // namespace hysteron
