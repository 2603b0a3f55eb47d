#include "study/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fit/free_coordinates.hpp"
#include "study/study.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

double cost_of(const RunRecord& record) { return record.nrmse.value_or(infinite); }

double cost_at(const RunRecord& record, double evaluations) {
  double best = infinite;
  for (const TracePoint& point : record.trace) {
    if (static_cast<double>(point.evaluations) > evaluations) break;
    best = point.best;
  }
  return best;
}

Attempt attempt(const RunRecord& record, double target) {
  for (const TracePoint& point : record.trace) {
    if (point.best <= target) return {true, static_cast<double>(point.evaluations)};
  }
  return {false, static_cast<double>(record.evaluations)};
}

std::vector<const RunRecord*> Cell::present() const {
  std::vector<const RunRecord*> result;
  for (const RunRecord* record : by_seed) {
    if (record != nullptr) result.push_back(record);
  }
  return result;
}

Cells::Cells(const json& plan, const std::vector<RunRecord>& records) : plan_(plan) {
  std::map<std::string, const RunRecord*> by_key;
  for (const RunRecord& record : records) by_key[record.key] = &record;
  problems_ = plan.at("problems").size();
  solvers_ = plan.at("solvers").size();
  budgets_ = plan.at("budgets").get<std::vector<std::size_t>>();
  seeds_ = plan.at("seeds").get<std::vector<std::uint64_t>>();
  tie_ = plan.at("tie").get<double>();
  equivalence_ = plan.value("equivalence", Study{}.equivalence);
  std::map<std::uint64_t, std::size_t> seed_index;
  for (std::size_t k = 0; k < seeds_.size(); ++k) seed_index[seeds_[k]] = k;
  cells_.resize(problems_ * budgets_.size() * solvers_);
  for (Cell& cell : cells_) cell.by_seed.resize(seeds_.size(), nullptr);
  best_.resize(problems_, nullptr);
  best_solver_.resize(problems_, 0);
  for (const json& run : plan.at("runs")) {
    ++planned_;
    const auto found = by_key.find(run.at("key").get<std::string>());
    if (found == by_key.end()) continue;
    ++done_;
    const auto problem = run.at("problem").get<std::size_t>();
    const auto solver = run.at("solver").get<std::size_t>();
    const auto budget =
        static_cast<std::size_t>(std::ranges::find(budgets_, run.at("budget").get<std::size_t>()) - budgets_.begin());
    const RunRecord* record = found->second;
    cells_[index(problem, budget, solver)].by_seed[seed_index.at(run.at("seed").get<std::uint64_t>())] = record;
    if (best_[problem] == nullptr || cost_of(*record) < cost_of(*best_[problem])) {
      best_[problem] = record;
      best_solver_[problem] = solver;
    }
  }
}

std::vector<std::vector<double>> Cells::by_seed(std::size_t problem, std::size_t budget) const {
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < seeds_.size(); ++k) {
    std::vector<double> row;
    for (std::size_t s = 0; s < solvers_; ++s) {
      const RunRecord* record = cell(problem, budget, s).by_seed[k];
      if (record != nullptr) row.push_back(cost_of(*record));
    }
    if (row.size() == solvers_) rows.push_back(std::move(row));
  }
  return rows;
}

double Cells::best_cost(std::size_t p) const { return best_[p] == nullptr ? infinite : cost_of(*best_[p]); }

std::vector<std::string> Cells::on_box(std::size_t p) const {
  std::vector<std::string> names;
  const json& problem = plan_.at("problems").at(p);
  if (best_[p] == nullptr || !problem.contains("box")) return names;
  const json parameters = json::parse(best_[p]->parameters);
  for (const auto& [name, range] : problem.at("box").items()) {
    if (!parameters.contains(name)) continue;
    const double lower = range.at(0).get<double>();
    const double upper = range.at(1).get<double>();
    if (on_bound((parameters.at(name).get<double>() - lower) / (upper - lower))) names.push_back(name);
  }
  return names;
}

}  // namespace hysteron
