// Time by solver and problem.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "study/store.hpp"

namespace hysteron {

// Apart from the analysis because it varies between identical studies. The expected time to the first target is the
// expected run time in `analysis` times the time of an evaluation.
[[nodiscard]] nlohmann::json analyse_times(const nlohmann::json& plan, const nlohmann::json& analysis,
                                           const std::vector<RunRecord>& records,
                                           const std::vector<RunTiming>& timings);

}  // namespace hysteron
