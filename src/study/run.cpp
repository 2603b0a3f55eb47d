#include "study/run.hpp"

#include <unistd.h>

#include <atomic>
#include <ctime>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "fit/driver.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr double tight_share = 1.0 / 256.0;

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

double heldout_nrmse(const StudyProblem& problem, const std::vector<Term>& terms, const ObjectiveOptions& options) {
  std::vector<Score> scores;
  for (const Recording& recording : problem.heldout) {
    scores.push_back(
        score(predict(problem.layout.model(), problem.layout.held(), terms, make_target(recording, options)), recording,
              options.normalisation));
  }
  return overall(scores, problem.heldout, options.normalisation, options.weighting);
}

// Processor time of the calling thread: what the clock on the wall says where the machine does nothing else.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Objectives of the problems under way: made when the first run of a problem starts, dropped after its last.
class Objectives {
 public:
  Objectives(const Plan& plan, std::vector<std::size_t> uses)
      : plan_(plan), uses_(std::move(uses)), made_(uses_.size()) {}

  std::shared_ptr<const Objective> take(std::size_t problem) {
    const std::lock_guard guard(mutex_);
    if (!made_[problem]) {
      ObjectiveOptions options = plan_.study.objective;
      options.threads = 1;
      made_[problem] = std::make_shared<const Objective>(plan_.problems[problem].layout,
                                                         plan_.problems[problem].recordings, options);
    }
    auto result = made_[problem];
    if (--uses_[problem] == 0) made_[problem].reset();
    return result;
  }

 private:
  const Plan& plan_;
  std::vector<std::size_t> uses_;
  std::vector<std::shared_ptr<const Objective>> made_;
  std::mutex mutex_;
};

}  // namespace

std::optional<RunRecord> do_run(const Plan& plan, const PlannedRun& run, const Objective& objective,
                                const std::function<bool()>& stop) {
  const StudyProblem& problem = plan.problems[run.problem];
  const SolverEntry* entry = find_solver(plan.study.solvers[run.solver].id);
  if (entry == nullptr) throw InputError("unknown solver '" + plan.study.solvers[run.solver].id + "'");
  Problem solved = solver_problem(problem, run, plan.study);
  objective.describe_data(solved);
  const RunResult result = run_solver(
      *entry, solved, [&](const Request& request) { return objective.evaluate(request); },
      [&](const RunResult&) { return !stop || !stop(); });
  if (result.stopped == "interrupted") return {};
  RunRecord record;
  record.key = run.key;
  record.config = run.config;
  record.evaluations = result.evaluations;
  record.diverged = result.diverged;
  record.stopped = result.stopped;
  for (const TracePoint& point : result.trace) {
    if (point.best < diverged_cost) record.trace.push_back(point);
  }
  json parameters = json::object();
  if (!result.best.empty() && result.cost < diverged_cost) {
    record.nrmse = result.cost;
    record.best = result.best;
    const std::vector<Term> terms = problem.layout.terms(result.best);
    for (const Term& term : terms) {
      parameters[term_name(problem.layout.names()[term.parameter], term.drive_power, term.frequency_power)] =
          term.value;
    }
    ObjectiveOptions options = plan.study.objective;
    options.threads = 1;
    if (!problem.heldout.empty()) {
      const double heldout = heldout_nrmse(problem, terms, options);
      if (heldout < diverged_cost) record.nrmse_heldout = heldout;
    }
    options.tolerance *= tight_share;
    const double tight = Objective(problem.layout, problem.recordings, options).evaluate({result.best, false}).cost[0];
    if (tight < diverged_cost) record.nrmse_tight = tight;
  }
  record.parameters = parameters.dump();
  return record;
}

RunProgress run_plan(const Plan& plan, Store& store, const RunOptions& options, const std::function<bool()>& stop,
                     const RunObserver& observer) {
  RunProgress progress;
  const std::set<std::string> have = store.keys();
  std::vector<const PlannedRun*> todo;
  std::vector<std::size_t> uses(plan.problems.size(), 0);
  for (const PlannedRun& run : plan.runs) {
    if (!in_shard(run.key, options.shard_index, options.shard_count)) continue;
    ++progress.planned;
    if (have.contains(run.key)) {
      ++progress.found;
      continue;
    }
    todo.push_back(&run);
    ++uses[run.problem];
  }
  const int wanted = team_size(options.threads);
  const std::string host = host_name();
  Objectives objectives(plan, std::move(uses));
  std::mutex writer;
  // What fails in one run ends the others at their next evaluation.
  std::atomic<bool> halted{false};
  const auto stopped = [&] { return halted.load(std::memory_order_relaxed) || (stop && stop()); };
  const auto run_and_record = [&](const PlannedRun& run) {
    const double begun = thread_seconds();
    const auto objective = objectives.take(run.problem);
    const std::optional<RunRecord> record = do_run(plan, run, *objective, stopped);
    if (!record) return;
    RunTiming timing{run.key, thread_seconds() - begun, host, wanted, static_cast<std::int64_t>(std::time(nullptr))};
    const std::lock_guard guard(writer);
    if (halted) return;
    store.add(*record, timing);
    ++progress.done;
    progress.last = plan.study.solvers[run.solver].label + " on " + plan.problems[run.problem].label;
    progress.nrmse = record->nrmse;
    if (observer) observer(progress);
  };
  parallel_for(todo.size(), wanted, [&](std::size_t k) {
    if (stopped()) return;
    try {
      run_and_record(*todo[k]);
    } catch (...) {
      halted = true;
      throw;
    }
  });
  return progress;
}

}  // namespace hysteron
