// What an effect explains where it acts. One that does exactly nothing elsewhere is judged by what stays there: what
// the model misses on the rest of the stroke is no doubt of it.
#pragma once

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// Sums over the samples where the effect changes the force by 2 % of the recording's normaliser, of squares of NRMSE.
struct Locality {
  double share = 0.0;   // of the samples
  double before = 0.0;  // of the hypothesis without the effect, refitted
  double after = 0.0;
  double noise = 0.0;
};

// Residuals of a fit with the effect, of the same hypothesis less it, refitted, and of the first with the effect
// switched off and nothing refitted. Samples at which any of them does not count do not.
Locality locality_of(const std::vector<Recording>& recordings, const Residuals& with, const Residuals& without,
                     const Residuals& switched_off);

}  // namespace hysteron
