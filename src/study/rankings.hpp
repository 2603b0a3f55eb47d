// Which solver is better, over problems and on each: Friedman's test, signed ranks, ratios with intervals.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "study/cells.hpp"

namespace hysteron {

inline constexpr double significance = 0.05;

// Mean ranks of the solvers over `problems` at the largest budget, who is apart from whom, and shares of first places.
nlohmann::json ranking(const Cells& study, const std::vector<std::size_t>& problems);
// Every two solvers over all problems: signed ranks, Holm's correction, cost ratio with interval and practical worth.
nlohmann::json pairs(const Cells& study);
// Likewise on each problem; with many solvers only against its best.
nlohmann::json problem_pairs(const Cells& study);

}  // namespace hysteron
