// A first look at everything that might join a fit: how much of what the fit leaves each extension could take off.
// The extension is simulated at finite sizes (a threshold does nothing at small ones), the fit's own parameters answer
// to first order:
//   r' = r - Q Q^T r,   s' = s - Q Q^T s,   gain = |projection of r' on the span of the s'|^2
// with Q an orthonormal basis of the fit's derivatives, s the changes of the simulated force at up to eight sizes and
// shapes. One derivative of the fit and one pack of plain simulations an extension, where a refit takes a hundred.
#pragma once

#include "diagnose/search/workbench.hpp"

namespace hysteron {

struct Scored {
  Extension part;
  double gain = 0.0;  // of the squares (of NRMSE), at most
  Starts starts;      // best first
};

// Of every extension, best first. `also` as in Workbench::from_fit; `most_starts` of each are simulated, all where 0.
// `done` is told the share of it that is done, from one thread at a time.
std::vector<Scored> scored(const Workbench& bench, const Fit& before, const std::vector<Extension>& extensions,
                           const Fit* also = nullptr, std::size_t most_starts = 0,
                           const std::function<void(double share)>& done = {});

}  // namespace hysteron
