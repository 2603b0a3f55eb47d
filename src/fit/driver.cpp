#include "fit/driver.hpp"

#include <algorithm>
#include <numeric>

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

namespace {

std::vector<const SolverEntry*>& catalogue() {
  static std::vector<const SolverEntry*> rows = [] {
    std::vector<const SolverEntry*> result;
    for (const SolverEntry* entry : solver_files()) {
      if (entry->members == nullptr) {
        result.push_back(entry);
      }
    }
    for (const SolverEntry* entry : solver_files()) {
      if (entry->members != nullptr) {
        const auto members = entry->members();
        result.insert(result.end(), members.begin(), members.end());
      }
    }
    return result;
  }();
  return rows;
}

}  // namespace

std::span<const SolverEntry* const> solver_catalogue() { return catalogue(); }

const SolverEntry* find_solver(std::string_view id) {
  const auto found = std::ranges::find_if(catalogue(), [&](const SolverEntry* entry) { return entry->id == id; });
  return found == catalogue().end() ? nullptr : *found;
}

const SolverEntry* find_solver_family(std::string_view id) {
  for (const SolverEntry* entry : solver_files()) {
    if (entry->members != nullptr && (entry->id == id || entry->id.substr(0, entry->id.find(':')) == id)) {
      return entry;
    }
  }
  return nullptr;
}

void add_solver(const SolverEntry* entry) {
  if (find_solver(entry->id) != nullptr) {
    throw InputError("solver '" + std::string(entry->id) + "' exists already, expected an id of its own");
  }
  catalogue().push_back(entry);
}

std::string RunResult::stopped() const {
  switch (ended_by) {
    case EndedBy::budget:
      return "budget";
    case EndedBy::interruption:
      return "interrupted";
    case EndedBy::solver:
      break;
  }
  return reason;
}

RunResult run_solver(const SolverEntry& entry, const Problem& problem, const Evaluate& evaluate,
                     const Observer& observer) {
  const auto solver = entry.make(problem);
  RunResult result;
  result.solver = std::string(entry.id);
  result.budget = problem.budget;
  result.cost = 3.0 * diverged_cost;
  const std::size_t d = problem.dimension;
  // Counted in samples, of which an evaluation has so many.
  const std::size_t samples =
      std::max<std::size_t>(1, std::accumulate(problem.recordings.begin(), problem.recordings.end(), std::size_t{0}));
  std::size_t spent = 0;
  const auto price_of = [&](const Request& request) {
    if (request.window && request.window->end > request.window->begin) {
      return request.window->end - request.window->begin;
    }
    return request.derivatives ? samples * (1 + d) : samples;
  };
  std::vector<double> screened;  // the best point of those only screened
  double screened_cost = 3.0 * diverged_cost;
  const auto record = [&](const Request& request, const Response& response) {
    const std::size_t price = price_of(request);
    for (std::size_t k = 0; k < response.cost.size(); ++k) {
      spent += price;
      result.evaluations = (spent + samples - 1) / samples;
      if (response.cost[k] >= diverged_cost) {
        ++result.diverged;
      }
      if (request.window) {
        continue;
      }
      double& cost = request.screening ? screened_cost : result.cost;
      if (response.cost[k] < cost) {
        cost = response.cost[k];
        const auto row = request.points.begin() + static_cast<std::ptrdiff_t>(k * d);
        (request.screening ? screened : result.best).assign(row, row + static_cast<std::ptrdiff_t>(d));
        if (!request.screening) {
          result.trace.push_back({result.evaluations, result.cost});
        }
      }
    }
  };
  const std::size_t budget = problem.budget * samples;
  // What is reported is never the result of a screening alone.
  const auto end = [&](EndedBy by) {
    if (result.best.empty() && !screened.empty() && spent + samples <= budget) {
      const Request request{screened, false};
      record(request, evaluate(request));
    }
    result.ended_by = by;
    result.track = solver->track();
    result.ends = solver->ends();
    return result;
  };
  while (true) {
    Request request;
    try {
      request = solver->ask();
    } catch (const Stopped&) {  // while a program of the user's own was waited for
      return end(EndedBy::interruption);
    }
    if (request.points.empty()) {
      result.reason = solver->stopped_because();
      return end(EndedBy::solver);
    }
    const std::size_t affordable = (budget - spent) / price_of(request);
    if (affordable == 0) {
      return end(EndedBy::budget);
    }
    request.points.resize(std::min(request.points.size() / d, affordable) * d);
    Response response;
    try {
      response = evaluate(request);
    } catch (const Stopped&) {
      result.ended_by = EndedBy::interruption;
      return result;
    }
    record(request, response);
    if (observer && !observer(result)) {
      return end(EndedBy::interruption);
    }
    if (spent >= budget) {
      return end(EndedBy::budget);
    }
    solver->tell(request, response);
  }
}

}  // namespace hysteron
