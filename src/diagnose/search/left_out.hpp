// What a fit would predict of recordings it had not seen: each motion with all its recordings is left out in turn, and
// the parameters that the others alone would have are found to first order, by one Gauss-Newton step from the fit.
//   delta_i = -(H - H_i)^-1 (g - g_i),   H = sum J_i^T J_i,   g = sum J_i^T r_i
// Source: approximate cross-validation, e.g. Beirami, Razaviyayn, Shahrampour, Tarokh, NIPS 2017. Of fewer than four
// motions single recordings are left out, and of fewer than four recordings quarters of each.
#pragma once

#include "diagnose/residual/block_score.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

struct LeftOut {
  BlockSquares predicted;  // of each fitted recording, by parameters that were not fitted to it
  // Likewise the residuals themselves, over the normaliser, behind the run-in.
  std::vector<std::vector<double>> residuals;
  double squares = 0.0;  // of NRMSE over all of them, by the parameters fitted to all, refined by one step
};
LeftOut left_out(const Workbench& bench, const Fit& fit);
// `done` is told the share of them that is done, from one thread at a time.
std::vector<LeftOut> left_out(const Workbench& bench, const std::vector<const Fit*>& fits,
                              const std::function<void(double share)>& done = {});

// For a fit to which `part` is to be added, or from which it was taken: `plain` (left_out of the fit) or left_out of
// Workbench::beside, whichever has the smaller squares.
LeftOut left_out_beside(const Workbench& bench, const Fit& fit, const Extension& part, LeftOut plain);

// Squared noise of each fitted recording over its normaliser^2: the floor of block_score.
std::vector<double> noise_of(const Workbench& bench);

}  // namespace hysteron
