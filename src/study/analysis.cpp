#include "study/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "study/cells.hpp"
#include "study/curves.hpp"
#include "study/quantile.hpp"
#include "study/rankings.hpp"
#include "study/targets.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

json problem_rows(const Cells& study) {
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    json row = study.plan().at("problems").at(p);
    row["best"] = nullptr;
    if (std::isfinite(study.best_cost(p))) {
      row["best"] = {{"nrmse", study.best_cost(p)},
                     {"key", study.best(p)->key},
                     {"solver", study.solver_name(study.best_solver(p))},
                     {"parameters", json::parse(study.best(p)->parameters)},
                     {"on_box", study.on_box(p)}};
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

struct ByPlace {
  std::vector<std::size_t> inside;
  std::vector<std::size_t> on_box;
};
// Problems by where their best known point lies: a solver that clips, reflects or projects does well or ill on those
// of the second kind for that alone.
ByPlace by_place_of_the_best(const Cells& study) {
  ByPlace result;
  for (std::size_t p = 0; p < study.problems(); ++p) {
    if (study.best(p) != nullptr) (study.on_box(p).empty() ? result.inside : result.on_box).push_back(p);
  }
  return result;
}

json fixed_budget(const Cells& study) {
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    for (std::size_t b = 0; b < study.budgets().size(); ++b) {
      for (std::size_t s = 0; s < study.solvers(); ++s) {
        const auto present = study.cell(p, b, s).present();
        if (present.empty()) continue;
        std::vector<double> costs;
        std::vector<double> heldout;
        std::vector<double> spent;
        std::vector<double> moved;
        std::size_t failed = 0;
        double diverged = 0.0;
        for (const RunRecord* record : present) {
          costs.push_back(cost_of(*record));
          spent.push_back(static_cast<double>(record->evaluations));
          diverged += static_cast<double>(record->diverged) / std::max(1.0, spent.back());
          failed += record->nrmse ? 0 : 1;
          if (record->nrmse_heldout) heldout.push_back(*record->nrmse_heldout);
          if (record->nrmse && record->nrmse_tight) {
            moved.push_back(std::fabs(*record->nrmse_tight - *record->nrmse) / *record->nrmse);
          }
        }
        const Quartiles q = quartiles(costs);
        rows.push_back({{"problem", p},
                        {"solver", s},
                        {"budget", study.budgets()[b]},
                        {"runs", present.size()},
                        {"failed", failed},
                        {"best", number_or_null(*std::ranges::min_element(costs))},
                        {"q1", number_or_null(q.lower)},
                        {"median", number_or_null(q.median)},
                        {"q3", number_or_null(q.upper)},
                        {"worst", number_or_null(*std::ranges::max_element(costs))},
                        {"heldout_median", heldout.empty() ? json(nullptr) : json(quantile(heldout, 0.5))},
                        {"evaluations_median", quantile(spent, 0.5)},
                        {"diverged_share", diverged / static_cast<double>(present.size())},
                        {"integration_shift", moved.empty() ? json(nullptr) : json(quantile(moved, 0.5))}});
      }
    }
  }
  return rows;
}

// The models of every dataset that has several, each with the solver of the lowest median at the largest budget, best
// first: by the median on held-out recordings where all of them have one, else by that on the fitted ones.
json models(const Cells& study, const json& cells) {
  const auto data_of = [&](const json& row) {
    return study.plan().at("problems").at(row.at("problem").get<std::size_t>()).at("data").get<std::string>();
  };
  std::map<std::string, std::map<std::size_t, json>> best;  // by data, then problem
  for (const json& row : cells) {
    if (row.at("budget") != study.budgets().back() || !row.at("median").is_number()) continue;
    auto& of_data = best[data_of(row)];
    const auto [at, added] = of_data.emplace(row.at("problem").get<std::size_t>(), row);
    if (!added && row.at("median") < at->second.at("median")) at->second = row;
  }
  json result = json::array();
  for (const auto& [data, problems] : best) {
    if (problems.size() < 2) continue;
    std::vector<json> rows;
    for (const auto& [problem, row] : problems) {
      const json& planned = study.plan().at("problems").at(problem);
      rows.push_back({{"data", data},
                      {"model", planned.at("model")},
                      {"dimension", planned.at("dimension")},
                      {"solver", row.at("solver")},
                      {"median", row.at("median")},
                      {"heldout_median", row.at("heldout_median")}});
    }
    const bool heldout =
        std::ranges::all_of(rows, [](const json& row) { return row.at("heldout_median").is_number(); });
    const char* by = heldout ? "heldout_median" : "median";
    std::ranges::stable_sort(rows, [&](const json& a, const json& b) { return a.at(by) < b.at(by); });
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k]["place"] = k + 1;
      rows[k]["ranked_by"] = heldout ? "held-out" : "fitted";
      result.push_back(std::move(rows[k]));
    }
  }
  return result;
}

json run_rows(const Cells& study) {
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    for (std::size_t b = 0; b < study.budgets().size(); ++b) {
      for (std::size_t k = 0; k < study.seeds().size(); ++k) {
        for (std::size_t s = 0; s < study.solvers(); ++s) {
          const RunRecord* record = study.cell(p, b, s).by_seed[k];
          if (record == nullptr) continue;
          rows.push_back({record->key, p, s, study.budgets()[b], study.seeds()[k],
                          record->nrmse ? json(*record->nrmse) : json(nullptr), record->evaluations, record->stopped});
        }
      }
    }
  }
  return rows;
}

// Of the runs of a problem at the largest budget that have no result, without its name: those that tried something, all
// together, and those that did not, whose solver and reason say why.
std::vector<std::string> failures(const Cells& study, std::size_t p) {
  std::size_t tried = 0;
  std::map<std::pair<std::size_t, std::string>, std::size_t> idle;  // by solver and reason
  for (std::size_t s = 0; s < study.solvers(); ++s) {
    for (const RunRecord* record : study.cell(p, study.last(), s).present()) {
      if (record->nrmse) continue;
      if (record->evaluations > 0) {
        ++tried;
      } else {
        ++idle[{s, record->stopped}];
      }
    }
  }
  std::vector<std::string> result;
  if (tried > 0) result.push_back(std::to_string(tried) + " runs found no candidate that stays finite; they rank last");
  for (const auto& [what, runs] : idle) {
    const auto& [solver, stopped] = what;
    const std::string why = stopped == "budget" ? "the budget of " + std::to_string(study.budgets().back()) +
                                                      " evaluations is too small for its first point"
                                                : "it stopped before the first: " + stopped;
    result.push_back(std::to_string(runs) + (runs == 1 ? " run of " : " runs of ") + study.solver_name(solver) +
                     " evaluated nothing (" + why + "); " + (runs == 1 ? "it ranks last" : "they rank last"));
  }
  return result;
}

json warnings(const Cells& study, const json& result) {
  json list = json::array();
  if (study.done() < study.planned()) {
    list.push_back(std::to_string(study.planned() - study.done()) + " of " + std::to_string(study.planned()) +
                   " runs are missing: everything below is of the others, and rankings of the seeds that every "
                   "solver has finished");
  }
  const std::size_t blocks = result.at("ranking").at("blocks").get<std::size_t>();
  const std::size_t tests = result.at("pairs").size();
  if (tests > 0 && blocks > 0 && blocks < 60 &&
      static_cast<double>(tests) * std::exp2(1.0 - static_cast<double>(blocks)) > significance) {
    const std::string block = result.at("ranking").at("block");
    list.push_back("with " + std::to_string(blocks) + " " + block + (blocks == 1 ? "" : "s") +
                   " no difference between two solvers can reach significance after Holm's correction: add " + block +
                   "s");
  }
  for (std::size_t p = 0; p < study.problems(); ++p) {
    std::vector<double> medians;
    double shift = 0.0;
    double lowest = infinite;
    for (const json& row : result.at("fixed_budget")) {
      if (row.at("problem") != p || row.at("budget") != study.budgets().back()) continue;
      if (row.at("median").is_null()) continue;
      medians.push_back(row.at("median").get<double>());
      if (medians.back() < lowest && !row.at("integration_shift").is_null()) {
        lowest = medians.back();
        shift = row.at("integration_shift").get<double>();
      }
    }
    std::ranges::sort(medians);
    if (medians.size() > 1) {
      const double gap = medians[1] / medians[0] - 1.0;
      if (shift > study.tie() && shift > gap) {
        char text[64];
        std::snprintf(text, sizeof text, "%.2g %%", 100.0 * shift);
        list.push_back(study.problem_name(p) + ": a finer integration moves the NRMSE of the leading solver by " +
                       text + ", more than its lead: use a smaller tolerance in the study");
      }
    }
    for (const std::string& text : failures(study, p)) list.push_back(study.problem_name(p) + ": " + text);
  }
  return list;
}

}  // namespace

json analyse(const json& plan, const std::vector<RunRecord>& records) {
  const Cells study(plan, records);
  json result;
  result["schema"] = "hysteron.study-analysis/1";
  result["equivalence"] = study.equivalence();
  for (const char* name : {"title", "normalisation", "weighting", "tolerance", "start", "targets", "target_nrmse",
                           "tie", "budgets", "seeds", "solvers"}) {
    result[name] = plan.at(name);
  }
  result["planned"] = study.planned();
  result["done"] = study.done();
  result["alpha"] = significance;
  result["problems"] = problem_rows(study);
  result["fixed_budget"] = fixed_budget(study);
  result["models"] = models(study, result["fixed_budget"]);
  std::vector<std::size_t> all(study.problems());
  std::iota(all.begin(), all.end(), std::size_t{0});
  result["ranking"] = ranking(study, all);
  if (const auto [inside, on_box] = by_place_of_the_best(study); !inside.empty() && !on_box.empty()) {
    result["ranking_inside"] = ranking(study, inside);
    result["ranking_on_box"] = ranking(study, on_box);
  }
  result["pairs"] = pairs(study);
  result["problem_pairs"] = problem_pairs(study);
  result["fixed_target"] = fixed_target(study);
  result["ecdf"] = ecdf(study);
  result["profiles"] = profiles(study);
  result["convergence"] = convergence(study);
  result["waterfall"] = waterfall(study);
  result["runs"] = run_rows(study);
  result["warnings"] = warnings(study, result);
  return result;
}

}  // namespace hysteron
