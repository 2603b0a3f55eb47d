// Values of parameters with their intervals. What recordings tell of a value holds for the catalogue's equation. The
// damper has another, and what of it is left over has moved the value as well. With the half width h of estimate(), the
// share s of the fit's NRMSE^2 that recurs with the motion beyond chance (recurrence.hpp), and the value's move m for
// each unit of NRMSE (Estimate::per_misfit) the interval is
//   value +- (h^2 + s NRMSE^2 m^2)^(1/2)
// It allows for unmodelled physics that accounts for all of what recurs and has half its shape in common with the
// effect: the bound of Cinelli and Hazlett, J. R. Stat. Soc. B 82 (2020) 39, at R^2 = 1/2, where the part of the
// physics that moves the value is as large as the part that stays.
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
    double unmodelled = 0.0;  // NRMSE of what recurs with the motion
  };
  // Valid until the next one.
  const Known& of(const Fit& fit);

  const Workbench* bench_;
  std::vector<Known> known_;
};

}  // namespace hysteron
