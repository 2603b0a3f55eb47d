#include "study/targets.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "study/proportion.hpp"

namespace hysteron {

using nlohmann::json;

std::vector<TargetLevel> levels(const Cells& study, std::size_t problem) {
  std::vector<TargetLevel> result;
  for (const json& factor : study.plan().at("targets")) {
    const auto f = factor.get<double>();
    char text[48];
    std::snprintf(text, sizeof text, "%g x best known", f);
    // A run that ends on the best cost itself reaches the target 1.0.
    result.push_back({text, f, study.best_cost(problem) * f * (1.0 + 1e-12)});
  }
  for (const json& value : study.plan().at("target_nrmse")) {
    char text[48];
    std::snprintf(text, sizeof text, "NRMSE %g", value.get<double>());
    result.push_back({text, 0.0, value.get<double>()});
  }
  return result;
}

std::vector<Attempt> attempts(const Cells& study, std::size_t p, std::size_t s, double target) {
  std::vector<Attempt> result;
  for (const RunRecord* record : study.cell(p, study.last(), s).present()) result.push_back(attempt(*record, target));
  return result;
}

json fixed_target(const Cells& study) {
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    if (!std::isfinite(study.best_cost(p))) continue;
    for (const TargetLevel& level : levels(study, p)) {
      for (std::size_t s = 0; s < study.solvers(); ++s) {
        const auto tries = attempts(study, p, s, level.value);
        if (tries.empty()) continue;
        const Stream stream = Stream(0)
                                  .child("expected run time")
                                  .child(study.problem_name(p))
                                  .child(study.solver_name(s))
                                  .child(level.label);
        const ExpectedRunTime time = expected_run_time(tries, stream);
        const Interval share = wilson(time.successes, time.runs);
        rows.push_back({{"problem", p},
                        {"target", level.label},
                        {"nrmse", level.value},
                        {"solver", s},
                        {"runs", time.runs},
                        {"successes", time.successes},
                        {"success_low", share.lower},
                        {"success_high", share.upper},
                        {"ert", time.value ? json(*time.value) : json(nullptr)},
                        {"ert_low", time.interval ? number_or_null(time.interval->lower) : json(nullptr)},
                        {"ert_high", time.interval ? number_or_null(time.interval->upper) : json(nullptr)},
                        {"spent", time.spent}});
      }
    }
  }
  return rows;
}

}  // namespace hysteron
