// What each recording alone would have a parameter be, the others held: where that follows amplitude, frequency, drive
// or order, the law lacks something that depends on it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// Of a recording: half stroke in m, frequency in Hz, mean drive in A or V, and its place in the order of recording.
constexpr std::array<const char*, 4> drift_variables = {"amplitude", "frequency", "drive", "order"};
using DriftConditions = std::array<double, drift_variables.size()>;

// What a relative change of a parameter adds to the residual, to first order: N at every sample of every recording.
struct Sensitivity {
  std::string name;
  std::vector<std::vector<double>> slope;
};

struct DriftOfParameter {
  std::string name;
  // By recording: the relative change that makes its squared error least to first order, and its standard error. Both
  // zero where the recording does not depend on the parameter.
  std::vector<double> change;
  std::vector<double> std_error;
  // Of drift_variables, the one it follows so closely that chance does not explain it; empty where none.
  std::string follows = {};
  double rank_correlation = 0.0;  // Spearman's, with that
};

struct Drift {
  std::vector<std::string> recordings;  // file names, the fitted ones
  std::vector<DriftConditions> conditions;
  std::vector<DriftOfParameter> parameters;  // as of the sensitivities
};

Drift drift_of(const std::vector<Recording>& recordings, const Residuals& residuals,
               const std::vector<Sensitivity>& sensitivities);

}  // namespace hysteron
