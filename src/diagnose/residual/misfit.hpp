// What a fit leaves, parted into noise and structure.
#pragma once

#include "core/squared.hpp"
#include "diagnose/residual/evenness.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// Sums of squares are of NRMSE: cost^2 over the fitted recordings.
struct Misfit {
  double squares = 0.0;    // cost^2
  double structure = 0.0;  // the part that is not noise
  double noise = 0.0;      // squares - structure
  // Squares of the noise by fourth differences, a lower bound of the noise, and as noise_floor estimates it; both with
  // what the noise of the motion makes of the model's force.
  double white = 0.0;
  double floor = 0.0;
  double motion = 0.0;       // the part of the floor that comes from the motion's noise
  double predictable = 0.0;  // share that repeats with the motion (structure.hpp)
  Evenness evenness;
  double independent = 0.0;  // values worth of independent information (independent.hpp)
};

Misfit misfit_of(const std::vector<Recording>& recordings, const Residuals& residuals);

// Structure beyond what noise and its estimate explain.
bool structured(const Misfit& misfit);

// Gain of the Bayesian information criterion from squares `before` to `after` for `more` parameters, by so many
// independent values.
double evidence(double before, double after, double more, double independent);

}  // namespace hysteron
