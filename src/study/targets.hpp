// What a study asks for: costs to be reached, and the evaluations it takes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/cells.hpp"

namespace hysteron {

struct TargetLevel {
  std::string label;
  double factor;  // 0: absolute
  double value;
};
// The targets of a problem, those relative to its best known cost first.
std::vector<TargetLevel> levels(const Cells& study, std::size_t problem);
// What every finished run of a solver on a problem took to `target`, at the largest budget.
std::vector<Attempt> attempts(const Cells& study, std::size_t problem, std::size_t solver, double target);
// Successes and expected evaluations of every solver to every target.
nlohmann::json fixed_target(const Cells& study);

}  // namespace hysteron
