// Genetic algorithm followed by pattern search from its best point (the "hybrid function" of MATLAB's ga).
//
//   ga for `ga_share` of the budget, then pattern search with mesh `mesh` around the best point for the rest
//
// Source: MathWorks, Global Optimization Toolbox documentation, ga option HybridFcn; used for damper identification
//   in place of either alone. The parts are those of ga.cpp and pattern_search.cpp, with their references.
// Deviations and doubts: the share is a choice made here (MATLAB switches when ga's stopping rules fire); ga alone is
// an
//   approximation, see there. When the pattern search has converged it goes on from random points, as it does alone.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_ga;
extern const SolverEntry solver_pattern_search;
extern const SolverEntry solver_ga_pattern_search;

namespace {

constexpr Setting settings[] = {
    {"ga_share", 0.5, 0.0, 1.0, "share of the budget given to the genetic algorithm"},
    {"population", 0.0, 0.0, 100000.0,
     "individuals of the genetic algorithm; 0 as for ga with its share of the budget"},
    {"mesh", 0.05, 1e-9, 1.0, "initial mesh of the pattern search as a fraction of the range"},
};

class HybridSearch final : public Solver {
 public:
  explicit HybridSearch(const Problem& problem) : problem_(problem) {
    const double share = setting(problem, solver_ga_pattern_search, "ga_share");
    genetic_budget_ = static_cast<std::size_t>(std::lround(share * static_cast<double>(problem.budget)));
    Problem part = problem;
    part.budget = genetic_budget_;
    part.stream = problem.stream.child("ga");
    part.settings = {
        {"population", static_cast<double>(support::whole_setting(problem, solver_ga_pattern_search, "population"))}};
    part_ = solver_ga.make(part);
    if (genetic_budget_ == 0) start_pattern_search();
  }

  Request ask() override {
    Request request = part_->ask();
    if (in_pattern_search_) return request;
    // Only what is left of the genetic algorithm's share is asked for.
    const std::size_t left = genetic_budget_ - used_;
    asked_ = std::min(left, request.points.size() / problem_.dimension);
    request.points.resize(asked_ * problem_.dimension);
    return request;
  }

  void tell(const Request& request, const Response& response) override {
    part_->tell(request, response);
    if (in_pattern_search_) return;
    for (std::size_t i = 0; i < response.cost.size(); ++i) {
      const double cost = support::ordered_cost(response.cost[i]);
      if (best_.empty() || cost < best_cost_) {
        const auto first = request.points.begin() + static_cast<std::ptrdiff_t>(i * problem_.dimension);
        best_.assign(first, first + static_cast<std::ptrdiff_t>(problem_.dimension));
        best_cost_ = cost;
      }
    }
    used_ += response.cost.size();
    if (response.cost.size() < asked_) {
      stopped_ = "points evaluated " + std::to_string(response.cost.size()) + " < points asked " +
                 std::to_string(asked_) + ": budget used";
    }
    if (used_ >= genetic_budget_) start_pattern_search();
  }

  [[nodiscard]] std::string stopped_because() const override {
    return in_pattern_search_ ? part_->stopped_because() : stopped_;
  }

 private:
  void start_pattern_search() {
    in_pattern_search_ = true;
    Problem part = problem_;
    part.budget = problem_.budget - std::min(problem_.budget, used_);
    part.stream = problem_.stream.child("pattern-search");
    if (!best_.empty()) part.start = best_;
    part.settings = {{"mesh", setting(problem_, solver_ga_pattern_search, "mesh")}};
    part_ = solver_pattern_search.make(part);
  }

  Problem problem_;
  std::unique_ptr<Solver> part_;
  bool in_pattern_search_ = false;
  std::size_t genetic_budget_ = 0;
  std::size_t used_ = 0;
  std::size_t asked_ = 0;
  support::Point best_;
  double best_cost_ = 0.0;
  std::string stopped_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_ga_pattern_search);
  return std::make_unique<HybridSearch>(problem);
}

}  // namespace

const SolverEntry solver_ga_pattern_search = {
    "ga-pattern-search",
    "Genetic algorithm, then pattern search",
    "MathWorks, Global Optimization Toolbox documentation, ga option HybridFcn",
    "Half of the budget to ga (an approximation of MATLAB's defaults), the rest to a generalised pattern search from\n"
    "the best point, with restarts.",
    false,
    settings,
    make,
};

}  // namespace hysteron
