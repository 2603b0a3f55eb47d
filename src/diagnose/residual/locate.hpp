// Where the misfit sits.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// An interval of one variable that holds more of the misfit than of the samples.
struct Location {
  std::string where;     // a sentence's end: "at speeds below 20 mm/s"
  std::string variable;  // "speed", "displacement", ...
  double from = 0.0;
  double to = 0.0;
  std::string unit;
  double share_of_misfit = 0.0;
  double share_of_samples = 0.0;
  double lowest_ratio = 0.0;            // 5 % quantile of misfit share over sample share, over resampled stretches
  std::vector<std::string> recordings;  // those that hold most of it
};

// Concentrations of the squared residual (less the noise), strongest first: share of misfit at least a fifth and 1.25
// times the share of samples, and more than that share at the 5 % quantile of a block bootstrap over stretches of the
// recordings.
std::vector<Location> locate(const std::vector<Recording>& recordings, const Residuals& residuals);

// Ends of the bins of a variable with these values, one or more: sixteen bins that hold as many values each, or, where
// the values are of few levels, noise on them or not, one for each level, which ends half way to the next.
std::vector<double> bin_edges(std::vector<double> values);

}  // namespace hysteron
