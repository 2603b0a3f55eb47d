// What a fit leaves of recordings, as it is looked at for what is none of the motion's (tone.hpp, wander.hpp).
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

// `norms`: N, what the force of each recording is divided by.
std::vector<Leftover> leftovers_of(const std::vector<Recording>& recordings, const std::vector<Residual>& residuals,
                                   const std::vector<double>& norms);

}  // namespace hysteron
