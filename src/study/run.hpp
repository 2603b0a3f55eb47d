// Doing the runs of a plan that a store does not hold yet.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "study/plan.hpp"
#include "study/store.hpp"

namespace hysteron {

struct RunOptions {
  int threads = 0;  // runs beside each other, one thread each; 0: OpenMP's default
  std::size_t shard_index = 1;
  std::size_t shard_count = 1;
};

struct RunProgress {
  std::size_t planned = 0;  // of this call: its shard
  std::size_t found = 0;    // in the store before
  std::size_t done = 0;     // by this call
  std::size_t index = 0;    // in Plan::runs, of the run that finished last
  double seconds = 0.0;     // it took
  std::optional<double> nrmse;
};

// Called from one thread at a time, after every run.
using RunObserver = std::function<void(const RunProgress&)>;

// What runs of one problem share: the objective of the search, and the one with a finer integration that scores the
// result again. Evaluations throw Stopped once `stop` is true.
struct Objectives {
  Objectives(const Plan& plan, std::size_t problem, const std::function<bool()>& stop = {});
  Objective search;
  Objective tight;
};

// One run from its configuration; absent when `stop` said so before the end.
[[nodiscard]] std::optional<RunRecord> do_run(const Plan& plan, const PlannedRun& run, const Objectives& objectives,
                                              const std::function<bool()>& stop);

// Indices of the runs of a shard that are not among the keys, in the order of the plan; counts planned and found.
[[nodiscard]] std::vector<std::size_t> missing_runs(const Plan& plan, const std::set<std::string>& have,
                                                    const RunOptions& options, RunProgress& progress);

// The next run to do, none when there is no more. Asked by one thread at a time, and may wait.
using RunSource = std::function<std::optional<std::size_t>()>;

// Does what the source says, in parallel; each run is stored as soon as it ends, by one writer at a time. Ends early
// when `stop` turns true; runs under way are then dropped and done again by the next call. The first failure of the
// store or the source stops the rest and is thrown. Results do not depend on the number of threads.
RunProgress run_from(const Plan& plan, Store& store, int threads, RunProgress progress, const RunSource& next,
                     const std::function<bool()>& stop, const RunObserver& observer);

// All runs missing in the store.
RunProgress run_plan(const Plan& plan, Store& store, const RunOptions& options, const std::function<bool()>& stop,
                     const RunObserver& observer);

// "solver on problem" of a run, for people.
[[nodiscard]] std::string label_of(const Plan& plan, std::size_t run);

}  // namespace hysteron
