// What an effect explains where it acts. One that does exactly nothing elsewhere is judged by what stays there: what
// the model misses on the rest of the stroke is no doubt of it.
#pragma once

#include <string>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Sums over the samples where the effect changes the force by 2 % of the recording's normaliser, of squares of NRMSE.
struct Locality {
  double share = 0.0;   // of the samples
  double before = 0.0;  // of the hypothesis without the effect, refitted
  double after = 0.0;
  double noise = 0.0;
};

// `with` holds the effect, `without` is the same hypothesis less it. Nothing acts where `effect` is not in `with`.
Locality locality_of(const Workbench& bench, const Fit& with, const Fit& without, const std::string& effect);

}  // namespace hysteron
