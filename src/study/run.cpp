#include "study/run.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "fit/driver.hpp"
#include "fit/parallel.hpp"
#include "fit/projection.hpp"

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
  return overall(scores, refer_to(problem.heldout), options.normalisation, options.weighting,
                 refer_to(problem.recordings));
}

// Processor time of the calling thread: what the clock on the wall says where the machine does nothing else.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ObjectiveOptions options_of(const Plan& plan, double tolerance_share, const std::function<bool()>& stop = {}) {
  ObjectiveOptions options = plan.study.objective;
  if (stop) options.stopped = stop;
  options.threads = 1;
  options.tolerance *= tolerance_share;
  return options;
}

// Objectives of the problems worked on last: making them takes longer than a short run, keeping all of a large study
// takes too much memory.
class LastObjectives {
 public:
  LastObjectives(const Plan& plan, std::size_t kept, std::function<bool()> stop)
      : plan_(plan), kept_(kept), stop_(std::move(stop)) {}

  std::shared_ptr<const Objectives> take(std::size_t problem) {
    const std::lock_guard guard(mutex_);
    const auto found = std::ranges::find(made_, problem, &Made::problem);
    if (found != made_.end()) {
      std::rotate(made_.begin(), found, found + 1);
      return made_.front().objectives;
    }
    auto objectives = std::make_shared<const Objectives>(plan_, problem, stop_);
    made_.insert(made_.begin(), Made{problem, objectives});
    if (made_.size() > kept_) made_.pop_back();
    return objectives;
  }

 private:
  struct Made {
    std::size_t problem;
    std::shared_ptr<const Objectives> objectives;
  };
  const Plan& plan_;
  std::size_t kept_;
  std::function<bool()> stop_;
  std::vector<Made> made_;  // last used first
  std::mutex mutex_;
};

}  // namespace

Objectives::Objectives(const Plan& plan, std::size_t problem, const std::function<bool()>& stop)
    : search(plan.problems[problem].layout, plan.problems[problem].recordings, options_of(plan, 1.0, stop)),
      tight(plan.problems[problem].layout, plan.problems[problem].recordings, options_of(plan, tight_share, stop)) {}

namespace {

// Throws Stopped where it is stopped outside the search.
std::optional<RunRecord> finished_run(const Plan& plan, const PlannedRun& run, const Objectives& objectives,
                                      const std::function<bool()>& stop) {
  const StudyProblem& problem = plan.problems[run.problem];
  const SolverEntry* entry = find_solver(plan.study.solvers[run.solver].id);
  if (entry == nullptr) throw InputError("unknown solver '" + plan.study.solvers[run.solver].id + "'");
  Problem solved = solver_problem(problem, run, plan.study);
  objectives.search.describe_data(solved);
  const auto run_it = plan.study.solvers[run.solver].project ? run_projected : run_solver;
  const RunResult result = run_it(
      *entry, solved, [&](const Request& request) { return objectives.search.evaluate(request); },
      [&](const RunResult&) { return !stop || !stop(); });
  if (result.ended_by == EndedBy::interruption) return {};
  RunRecord record;
  record.key = run.key;
  record.config = run.config;
  record.evaluations = result.evaluations;
  record.diverged = result.diverged;
  record.stopped = result.stopped();
  for (const TracePoint& point : result.trace) {
    if (point.best < diverged_cost) record.trace.push_back(point);
  }
  json parameters = json::object();
  if (!result.best.empty() && result.cost < diverged_cost) {
    record.nrmse = result.cost;
    record.best = result.best;
    const std::vector<Term> terms = problem.layout.terms(result.best);
    for (const Term& term : terms) {
      parameters[term_name(problem.layout.names()[term.parameter], term, problem.layout.conditions())] = term.value;
    }
    if (!problem.heldout.empty()) {
      const double heldout = heldout_nrmse(problem, terms, options_of(plan, 1.0));
      if (heldout < diverged_cost) record.nrmse_heldout = heldout;
    }
    const double tight = objectives.tight.evaluate({result.best, false}).cost[0];
    if (tight < diverged_cost) record.nrmse_tight = tight;
  }
  record.parameters = parameters.dump();
  return record;
}

}  // namespace

std::optional<RunRecord> do_run(const Plan& plan, const PlannedRun& run, const Objectives& objectives,
                                const std::function<bool()>& stop) {
  try {
    return finished_run(plan, run, objectives, stop);
  } catch (const Stopped&) {
    return {};
  }
}

std::vector<std::size_t> missing_runs(const Plan& plan, const std::set<std::string>& have, const RunOptions& options,
                                      RunProgress& progress) {
  std::vector<std::size_t> todo;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    if (!in_shard(plan.runs[k].key, options.shard_index, options.shard_count)) continue;
    ++progress.planned;
    if (have.contains(plan.runs[k].key)) {
      ++progress.found;
    } else {
      todo.push_back(k);
    }
  }
  return todo;
}

RunProgress run_from(const Plan& plan, Store& store, int threads, RunProgress progress, const RunSource& next,
                     const std::function<bool()>& stop, const RunObserver& observer) {
  const int wanted = team_size(threads);
  const std::string host = host_name();
  std::mutex source;
  std::mutex writer;
  // What fails in one run ends the others at their next evaluation.
  std::atomic<bool> halted{false};
  const auto stopped = [&] { return halted.load(std::memory_order_relaxed) || (stop && stop()); };
  LastObjectives last(plan, static_cast<std::size_t>(wanted) + 1, stopped);
  const auto work = [&] {
    while (!stopped()) {
      std::optional<std::size_t> index;
      {
        const std::lock_guard guard(source);
        index = next();
      }
      if (!index) return;
      const PlannedRun& run = plan.runs[*index];
      const double begun = thread_seconds();
      const auto objectives = last.take(run.problem);
      const std::optional<RunRecord> record = do_run(plan, run, *objectives, stopped);
      if (!record) return;
      const double seconds = thread_seconds() - begun;
      const RunTiming timing{run.key, seconds, host, wanted, static_cast<std::int64_t>(std::time(nullptr))};
      const std::lock_guard guard(writer);
      if (halted) return;
      store.add(*record, timing);
      ++progress.done;
      progress.index = *index;
      progress.seconds = seconds;
      progress.nrmse = record->nrmse;
      if (observer) observer(progress);
    }
  };
  parallel_for(static_cast<std::size_t>(wanted), wanted, [&](std::size_t) {
    try {
      work();
    } catch (...) {
      halted = true;
      throw;
    }
  });
  return progress;
}

RunProgress run_plan(const Plan& plan, Store& store, const RunOptions& options, const std::function<bool()>& stop,
                     const RunObserver& observer) {
  RunProgress progress;
  const std::vector<std::size_t> todo = missing_runs(plan, store.keys(), options, progress);
  std::size_t taken = 0;
  const auto next = [&]() -> std::optional<std::size_t> {
    if (taken == todo.size()) return {};
    return todo[taken++];
  };
  return run_from(plan, store, options.threads, progress, next, stop, observer);
}

std::string label_of(const Plan& plan, std::size_t run) {
  return plan.study.solvers[plan.runs[run].solver].label + " on " + plan.problems[plan.runs[run].problem].label;
}

}  // namespace hysteron
