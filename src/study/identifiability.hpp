// What the data of a study say of the parameters of its best fits: correlations, sloppiness, profiles.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "study/plan.hpp"
#include "study/store.hpp"

namespace hysteron {

// For every problem the best run of any solver, budget and seed, followed down to the bottom by Levenberg-Marquardt:
// - correlations of the free parameters there, from the Gauss-Newton matrix;
// - its eigenvalues for relative changes of the parameters (logarithms; of parameters that can be zero or negative,
//   shares of the box), largest 1: a spectrum over many decades is sloppy, the smallest directions are named;
// - profiles: each parameter held at values around its own, all others fitted again, with the 95 % threshold of the
//   likelihood ratio for the effective number of samples (residuals are correlated).
// Deterministic: from the plan and its records only. Empty ("problems" is null) when `stop` said so before the end, or
// while runs of the plan are missing.
[[nodiscard]] nlohmann::json identifiability(const Plan& plan, const std::vector<RunRecord>& records, int threads,
                                             const std::function<bool()>& stop);

// What it depends on: the best run of every problem. A stored result with another one is of an earlier state.
[[nodiscard]] std::vector<const RunRecord*> best_runs(const nlohmann::json& plan,
                                                      const std::vector<RunRecord>& records);

}  // namespace hysteron
