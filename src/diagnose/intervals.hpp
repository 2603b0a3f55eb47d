// Values of parameters with their intervals.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/gather.hpp"
#include "fit/identify.hpp"

namespace hysteron {

// Estimates of the fits that have been asked for: one fit is asked for several effects, and derivatives behind series
// elements take long.
class Estimates {
 public:
  explicit Estimates(const Workbench& bench) : bench_(&bench) {}

  // Of an effect of the fit, or of the parameter in which its law has it as a part of its own.
  [[nodiscard]] std::vector<ParameterInterval> intervals(const Fit& fit, const std::string& effect);

 private:
  struct Known {
    Hypothesis what;
    std::vector<double> point;
    std::vector<Estimate> estimates;
  };
  // Valid until the next one.
  const std::vector<Estimate>& of(const Fit& fit);

  const Workbench* bench_;
  std::vector<Known> known_;
};

}  // namespace hysteron
