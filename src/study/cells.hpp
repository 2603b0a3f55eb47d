// The records of a study in their places: problem, budget, solver, seed.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/runtime.hpp"
#include "study/store.hpp"

namespace hysteron {

// A number as JSON has it: null where it is not finite.
nlohmann::json number_or_null(double value);

// NRMSE of a run; infinite where no candidate stayed finite.
double cost_of(const RunRecord& record);
// Best cost a run had after `evaluations`.
double cost_at(const RunRecord& record, double evaluations);
// Whether and after how many evaluations a run reached `target`.
Attempt attempt(const RunRecord& record, double target);

struct Cell {
  std::vector<const RunRecord*> by_seed;  // null where the run is missing
  [[nodiscard]] std::vector<const RunRecord*> present() const;
};

// Holds on to `plan` (plan_json()) and `records`. Runs of the plan without a record are counted and left out.
class Cells {
 public:
  Cells(const nlohmann::json& plan, const std::vector<RunRecord>& records);

  [[nodiscard]] const nlohmann::json& plan() const { return plan_; }
  [[nodiscard]] std::size_t problems() const { return problems_; }
  [[nodiscard]] std::size_t solvers() const { return solvers_; }
  [[nodiscard]] const std::vector<std::size_t>& budgets() const { return budgets_; }
  [[nodiscard]] std::size_t last() const { return budgets_.size() - 1; }  // the largest budget
  [[nodiscard]] const std::vector<std::uint64_t>& seeds() const { return seeds_; }
  [[nodiscard]] std::size_t planned() const { return planned_; }
  [[nodiscard]] std::size_t done() const { return done_; }
  // Costs this close to each other, relatively, are equal.
  [[nodiscard]] double tie() const { return tie_; }
  // Costs this close to each other, relatively, do the same in practice.
  [[nodiscard]] double equivalence() const { return equivalence_; }

  [[nodiscard]] std::string solver_name(std::size_t s) const { return plan_.at("solvers").at(s).at("label"); }
  [[nodiscard]] std::string problem_name(std::size_t p) const { return plan_.at("problems").at(p).at("label"); }

  [[nodiscard]] const Cell& cell(std::size_t problem, std::size_t budget, std::size_t solver) const {
    return cells_[index(problem, budget, solver)];
  }
  // Costs of one problem at one budget, a row a seed that every solver has finished.
  [[nodiscard]] std::vector<std::vector<double>> by_seed(std::size_t problem, std::size_t budget) const;

  // The run of the lowest cost on a problem, null where there is none; that cost, infinite likewise; who found it.
  [[nodiscard]] const RunRecord* best(std::size_t p) const { return best_[p]; }
  [[nodiscard]] double best_cost(std::size_t p) const;
  [[nodiscard]] std::size_t best_solver(std::size_t p) const { return best_solver_[p]; }
  // Parameters that this run has on an end of their range.
  [[nodiscard]] std::vector<std::string> on_box(std::size_t p) const;

 private:
  [[nodiscard]] std::size_t index(std::size_t problem, std::size_t budget, std::size_t solver) const {
    return (problem * budgets_.size() + budget) * solvers_ + solver;
  }

  const nlohmann::json& plan_;
  std::size_t problems_ = 0;
  std::size_t solvers_ = 0;
  std::vector<std::size_t> budgets_;
  std::vector<std::uint64_t> seeds_;
  double tie_ = 0.0;
  double equivalence_ = 0.0;
  std::vector<Cell> cells_;
  std::vector<const RunRecord*> best_;
  std::vector<std::size_t> best_solver_;
  std::size_t planned_ = 0;
  std::size_t done_ = 0;
};

}  // namespace hysteron
