#include "study/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "study/quantile.hpp"
#include "study/targets.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int ecdf_targets = 41;
constexpr double ecdf_closest = 1e-3;  // of the distance to the best known cost, relative to it
constexpr double ecdf_farthest = 10.0;
constexpr std::size_t curve_points = 80;

std::vector<double> log_grid(double low, double high, std::size_t count) {
  std::vector<double> grid;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
    grid.push_back(low * std::pow(high / low, share));
  }
  return grid;
}

// Whole evaluation counts, log-spaced, without repeats.
std::vector<double> evaluation_grid(double budget) {
  std::vector<double> grid;
  for (const double value : log_grid(1.0, std::max(budget, 2.0), curve_points)) {
    const double whole = std::round(value);
    if (grid.empty() || whole > grid.back()) grid.push_back(whole);
  }
  return grid;
}

}  // namespace

json ecdf(const Cells& study) {
  const std::vector<double> grid = evaluation_grid(static_cast<double>(study.budgets().back()));
  const std::vector<double> distances = log_grid(ecdf_closest, ecdf_farthest, ecdf_targets);
  json curves = json::array();
  for (std::size_t s = 0; s < study.solvers(); ++s) {
    std::vector<double> hits;
    for (std::size_t p = 0; p < study.problems(); ++p) {
      if (!std::isfinite(study.best_cost(p))) continue;
      for (const RunRecord* record : study.cell(p, study.last(), s).present()) {
        for (const double distance : distances) {
          const Attempt found = attempt(*record, study.best_cost(p) * (1.0 + distance));
          hits.push_back(found.success ? found.evaluations : infinite);
        }
      }
    }
    curves.push_back(distribution(hits, grid));
  }
  return {{"evaluations", grid},
          {"share", curves},
          {"targets", ecdf_targets},
          {"closest", ecdf_closest},
          {"farthest", ecdf_farthest}};
}

json profiles(const Cells& study) {
  // Performance: expected run time of every (problem, target). Data: every (problem, seed) at the first target.
  std::vector<std::vector<double>> expected;
  for (std::size_t p = 0; p < study.problems(); ++p) {
    if (!std::isfinite(study.best_cost(p))) continue;
    for (const TargetLevel& level : levels(study, p)) {
      std::vector<double> row;
      for (std::size_t s = 0; s < study.solvers(); ++s) {
        double spent = 0.0;
        double successes = 0.0;
        for (const Attempt& one : attempts(study, p, s, level.value)) {
          spent += one.evaluations;
          successes += one.success ? 1.0 : 0.0;
        }
        row.push_back(successes > 0.0 ? spent / successes : infinite);
      }
      expected.push_back(std::move(row));
    }
  }
  std::vector<std::vector<double>> single;
  std::vector<std::size_t> dimensions;
  std::size_t smallest = std::numeric_limits<std::size_t>::max();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    const auto dimension = study.plan().at("problems").at(p).at("dimension").get<std::size_t>();
    smallest = std::min(smallest, dimension);
    if (!std::isfinite(study.best_cost(p)) || levels(study, p).empty()) continue;
    const double target = levels(study, p).front().value;
    for (std::size_t k = 0; k < study.seeds().size(); ++k) {
      std::vector<double> row;
      for (std::size_t s = 0; s < study.solvers(); ++s) {
        const RunRecord* record = study.cell(p, study.last(), s).by_seed[k];
        if (record == nullptr) continue;
        const Attempt one = attempt(*record, target);
        row.push_back(one.success ? one.evaluations : infinite);
      }
      if (row.size() != study.solvers()) continue;
      single.push_back(std::move(row));
      dimensions.push_back(dimension);
    }
  }
  const std::vector<double> ratios = log_grid(1.0, 100.0, curve_points);
  const std::vector<double> budgets =
      log_grid(1.0, std::max(2.0, static_cast<double>(study.budgets().back()) / static_cast<double>(smallest + 1)),
               curve_points);
  return {{"ratios", ratios},
          {"performance", performance_profile(expected, ratios)},
          {"performance_cases", expected.size()},
          {"simplex_gradients", budgets},
          {"data", data_profile(single, dimensions, budgets)},
          {"data_cases", single.size()},
          {"data_target",
           study.problems() > 0 && !levels(study, 0).empty() ? json(levels(study, 0).front().label) : json(nullptr)}};
}

json convergence(const Cells& study) {
  const std::vector<double> grid = evaluation_grid(static_cast<double>(study.budgets().back()));
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    for (std::size_t s = 0; s < study.solvers(); ++s) {
      const auto present = study.cell(p, study.last(), s).present();
      if (present.empty()) continue;
      json median = json::array();
      json lower = json::array();
      json upper = json::array();
      for (const double at : grid) {
        std::vector<double> costs(present.size());
        std::ranges::transform(present, costs.begin(), [&](const RunRecord* record) { return cost_at(*record, at); });
        const Quartiles q = quartiles(costs);
        median.push_back(number_or_null(q.median));
        lower.push_back(number_or_null(q.lower));
        upper.push_back(number_or_null(q.upper));
      }
      rows.push_back({{"problem", p}, {"solver", s}, {"median", median}, {"q1", lower}, {"q3", upper}});
    }
  }
  return {{"evaluations", grid}, {"rows", rows}};
}

json waterfall(const Cells& study) {
  json rows = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    for (std::size_t s = 0; s < study.solvers(); ++s) {
      std::vector<double> costs;
      for (const RunRecord* record : study.cell(p, study.last(), s).present()) {
        if (record->nrmse) costs.push_back(*record->nrmse);
      }
      std::ranges::sort(costs);
      rows.push_back({{"problem", p}, {"solver", s}, {"nrmse", costs}});
    }
  }
  return rows;
}

}  // namespace hysteron
