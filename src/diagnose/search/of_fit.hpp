// Statistics of a fit that is simulated for each anew. Where several are asked for, Workbench::residuals is simulated
// once and handed to them.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/residual/recurrence.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Plain numbers of a fit, as a piece of the workbench's work.
template <class Numbers, class Work>
Numbers numbers_of_fit(const Workbench& bench, const Fit& fit, const char* name, const Work& work) {
  static_assert(std::is_trivially_copyable_v<Numbers>);
  ByteWriter key;
  key.text(name);
  add_fit(key, fit);
  const std::string bytes = bench.piece(key, [&] {
    const Numbers result = work();
    return std::string(reinterpret_cast<const char*>(&result), sizeof result);
  });
  Numbers result;
  std::memcpy(&result, bytes.data(), sizeof result);
  return result;
}

inline Misfit misfit_of(const Workbench& bench, const Fit& fit) {
  return numbers_of_fit<Misfit>(bench, fit, "misfit",
                                [&] { return misfit_of(bench.split().fit, bench.residuals(fit)); });
}

inline Recurrence recurrence_of(const Workbench& bench, const Fit& fit) {
  return numbers_of_fit<Recurrence>(bench, fit, "recurrence",
                                    [&] { return recurrence_of(bench.split().fit, bench.residuals(fit)); });
}

inline Drift drift_of(const Workbench& bench, const Fit& fit) {
  const Residuals residuals = bench.residuals(fit);
  return drift_of(bench.split().fit, residuals, bench.sensitivities(fit, residuals));
}

}  // namespace hysteron
