// Whether what a fit leaves recurs with the motion: how much of it one smooth function of displacement, velocity,
// acceleration, simulated force, stroke and drive takes off all recordings together. Noise of any colour knows nothing
// of the motion, and the function takes no more off it than off its surrogates (surrogate.hpp). Pooled over
// the recordings a far smaller part is seen than within each (structure.hpp). A constant and a multiple of the force
// are taken off each recording first: by these, recordings may differ by chance.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

struct Recurrence {
  double share = 0.0;           // of the squared residual that the function takes off
  double mean_by_chance = 0.0;  // of nineteen surrogates
  double most_by_chance = 0.0;  // likewise, the largest
};

// Recordings of fewer than 200 samples are left out.
Recurrence recurrence_of(const std::vector<Recording>& recordings, const Residuals& residuals);

// Whether chance does not explain the share. False where nothing is known.
inline bool recurs(const Recurrence& recurrence) {
  return recurrence.share - recurrence.mean_by_chance > 1.5 * (recurrence.most_by_chance - recurrence.mean_by_chance);
}

}  // namespace hysteron
