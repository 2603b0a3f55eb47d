// Statistics of a fit that is simulated for each anew. Where several are asked for, Workbench::residuals is simulated
// once and handed to them.
#pragma once

#include "diagnose/residual/misfit.hpp"
#include "diagnose/residual/recurrence.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

inline Misfit misfit_of(const Workbench& bench, const Fit& fit) {
  return misfit_of(bench.split().fit, bench.residuals(fit));
}

inline Recurrence recurrence_of(const Workbench& bench, const Fit& fit) {
  return recurrence_of(bench.split().fit, bench.residuals(fit));
}

inline Drift drift_of(const Workbench& bench, const Fit& fit) {
  const Residuals residuals = bench.residuals(fit);
  return drift_of(bench.split().fit, residuals, bench.sensitivities(fit, residuals));
}

}  // namespace hysteron
