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

}  // namespace hysteron
