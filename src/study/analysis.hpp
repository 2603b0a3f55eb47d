// From the records of a study to what a report states: every number a report shows is computed here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "study/store.hpp"

namespace hysteron {

// Rankings, fixed-budget and fixed-target tables, tests, distributions, profiles, convergence bands and waterfalls, as
// JSON ("hysteron.study-analysis/1"), from plan_json() and the records found. Runs of the plan without a record are
// counted and left out. Depends on nothing else: equal stores give equal bytes. Evaluations to a target, profiles and
// rankings are those of the largest budget of the plan.
[[nodiscard]] nlohmann::json analyse(const nlohmann::json& plan, const std::vector<RunRecord>& records);

// Time by solver and problem, apart because it varies between identical studies. The expected time to the first target
// is the expected run time in `analysis` times the time of an evaluation.
[[nodiscard]] nlohmann::json analyse_times(const nlohmann::json& plan, const nlohmann::json& analysis,
                                           const std::vector<RunRecord>& records,
                                           const std::vector<RunTiming>& timings);

}  // namespace hysteron
