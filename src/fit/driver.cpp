#include "fit/driver.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace hysteron {

double setting(const Problem& problem, const SolverEntry& entry, std::string_view name) {
  if (const auto own = problem.settings.find(std::string(name)); own != problem.settings.end()) {
    return own->second;
  }
  for (const Setting& row : entry.settings) {
    if (row.name == name) {
      return row.value;
    }
  }
  throw InputError("solver '" + std::string(entry.id) + "' has no setting '" + std::string(name) + "'");
}

const SolverEntry* find_solver(std::string_view id) {
  const auto catalogue = solver_catalogue();
  const auto found = std::ranges::find_if(catalogue, [&](const SolverEntry* entry) { return entry->id == id; });
  return found == catalogue.end() ? nullptr : *found;
}

RunResult run_solver(const SolverEntry& entry, const Problem& problem, const Evaluate& evaluate,
                     const Observer& observer) {
  const auto solver = entry.make(problem);
  RunResult result;
  result.solver = std::string(entry.id);
  result.budget = problem.budget;
  result.cost = 3.0 * diverged_cost;
  const std::size_t d = problem.dimension;
  while (true) {
    Request request = solver->ask();
    if (request.points.empty()) {
      result.stopped = solver->stopped_because();
      return result;
    }
    const std::size_t price = request.derivatives ? 1 + d : 1;
    const std::size_t affordable = (problem.budget - result.evaluations) / price;
    if (affordable == 0) {
      result.stopped = "budget";
      return result;
    }
    const std::size_t count = std::min(request.points.size() / d, affordable);
    request.points.resize(count * d);
    const Response response = evaluate(request);
    for (std::size_t k = 0; k < count; ++k) {
      result.evaluations += price;
      if (response.cost[k] >= diverged_cost) {
        ++result.diverged;
      }
      if (response.cost[k] < result.cost) {
        result.cost = response.cost[k];
        const auto row = request.points.begin() + static_cast<std::ptrdiff_t>(k * d);
        result.best.assign(row, row + static_cast<std::ptrdiff_t>(d));
        result.trace.push_back({result.evaluations, result.cost});
      }
    }
    if (observer && !observer(result)) {
      result.stopped = "interrupted";
      return result;
    }
    if (result.evaluations >= problem.budget) {
      result.stopped = "budget";
      return result;
    }
    solver->tell(request, response);
  }
}

}  // namespace hysteron
