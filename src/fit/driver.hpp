// The evaluation loop around a solver: one external counter, the budget cut exactly, best and trace kept.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/solver.hpp"

namespace hysteron {

struct TracePoint {
  std::size_t evaluations;
  double best;
};

// What ended a run: the solver, which has a reason of its own, the budget, or an interruption from outside.
enum class EndedBy { solver, budget, interruption };

struct RunResult {
  std::string solver;
  std::vector<double> best;  // unit coordinates
  double cost = 0.0;
  std::size_t evaluations = 0;
  std::size_t budget = 0;
  std::size_t diverged = 0;
  std::vector<TracePoint> trace;  // at every improvement
  EndedBy ended_by = EndedBy::solver;
  std::string reason;          // of the solver, where that ended the run
  std::vector<Tracked> track;  // Solver::track
  Ends ends;                   // Solver::ends

  // "budget", the solver's own reason, or "interrupted".
  [[nodiscard]] std::string stopped() const;
};

using Evaluate = std::function<Response(const Request&)>;
// Called after every answer; false stops the run.
using Observer = std::function<bool(const RunResult&)>;

// A request with derivatives is charged 1 + dimension evaluations a point, as finite differences would be; one of a
// window the window's share of the samples. `evaluations` is rounded up, and the budget is never passed.
RunResult run_solver(const SolverEntry& entry, const Problem& problem, const Evaluate& evaluate,
                     const Observer& observer = {});

}  // namespace hysteron
