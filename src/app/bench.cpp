// hysteron bench: runs a study, resuming what an interrupted call left.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/study_output.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "mpi/mpi_peers.hpp"
#include "report/study.hpp"
#include "study/gather.hpp"
#include "study/study_file.hpp"

namespace hysteron::app {
namespace {

struct Shard {
  std::size_t index = 1;
  std::size_t count = 1;
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  const auto slash = text.find('/');
  const auto digits = [](const std::string& word) {
    return !word.empty() && word.size() < 7 && word.find_first_not_of("0123456789") == std::string::npos;
  };
  const std::string first = text.substr(0, slash);
  const std::string second = slash == std::string::npos ? "" : text.substr(slash + 1);
  if (digits(first) && digits(second)) {
    shard.index = std::stoul(first);
    shard.count = std::stoul(second);
    if (shard.index >= 1 && shard.index <= shard.count) return shard;
  }
  throw InputError("--shard: '" + text + "' is wrong, expected I/N with 1 <= I <= N, e.g. 2/8");
}

// Whether runs are missing, which is said.
bool tell_interrupted(const RunProgress& progress, const std::string& out) {
  const std::size_t there = progress.found + progress.done;
  if (there == progress.planned) return false;
  fmt::print(stderr, "interrupted: {} of {} runs are kept in {}; the same command continues\n", there, progress.planned,
             printable(out));
  return true;
}

// Of a whole study, which may be one of several shards.
void conclude(const Plan& plan, Store& store, const RunProgress& progress, const RunOptions& options,
              const std::string& out, bool quiet) {
  std::vector<RunRecord> records = store.records();
  // A shard knows a part of the runs only: the best may be elsewhere.
  if (options.shard_count == 1) add_identifiability(plan, store, records, options.threads, quiet);
  fmt::print("{} run{} done, {} found in {}\n\n", progress.done, progress.done == 1 ? "" : "s", progress.found,
             printable(out));
  const StudyView view = view_of(store, std::move(records), out);
  fmt::print("{}\nThe whole report: hysteron report {}\n", study_terminal(view.analysis, view.times), printable(out));
  warn_of_failed_ends();
}

// As one of several ranks of mpirun. Only the first says anything, and all end with the same status.
void run_together(const std::string& study, const std::string& out, RunOptions options, bool quiet) {
  // Ranks are as many as the cores they are given.
  if (options.threads == 0) options.threads = 1;
  RanksOutcome outcome;
  bool first = false;
  std::optional<Plan> plan;
  {
    const std::unique_ptr<Peers> peers = start_mpi();
    first = peers->rank() == 0;
    PlanOrFailure own = try_plan([&] { return make_plan(read_study_file(study), HYSTERON_VERSION); });
    std::optional<StudyProgress> line;
    if (first && own.plan) tell(own.plan->remarks);
    if (first && own.plan) line.emplace(*own.plan, quiet);
    outcome = run_ranks(own, out, options, *peers, interrupted, [&](const RunProgress& now) { line->show(now); });
    if (line) line->finish();
    if (line && !quiet) {
      fmt::print(stderr, "{} ranks: {} questions answered in {:.6f} s, stores taken in in {:.6f} s\n", peers->size(),
                 outcome.questions, outcome.answering, outcome.gathering);
    }
    line.reset();
    plan = std::move(own.plan);
  }
  if (first && outcome.status == 0) {
    Store store = Store::open(out, Store::Mode::write);
    conclude(*plan, store, outcome.progress, options, out, quiet);
  } else if (first && !outcome.message.empty()) {
    fmt::print(stderr, "error: {}\n", printable(outcome.message));
  } else if (first) {
    tell_interrupted(outcome.progress, out);
  }
  if (outcome.status != 0) throw Ended{outcome.status};
}

}  // namespace

void add_bench(CLI::App& program) {
  struct Options {
    std::string study;
    std::vector<std::string> solver_commands;
    std::string out;
    std::string shard;
    int threads = 0;
    bool quiet = false;
    bool dry = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("bench", "runs a study: models x data x solvers x seeds; resumes an interrupted one");
  command->add_option("STUDY", options->study, "study file (TOML), see docs/studies.md")->required();
  command->add_option("--out", options->out, "folder of the records; an earlier call's is continued")->required();
  command->add_option("--threads", options->threads, "runs beside each other; 0 takes OMP_NUM_THREADS or all cores")
      ->transform(whole_number(0, 1024))
      ->capture_default_str();
  add_solver_option(*command, options->solver_commands);
  command->add_option("--shard", options->shard, "I/N: only the I-th of N parts of the runs, see `hysteron merge`");
  command->add_flag("--dry-run", options->dry, "says what would be run and writes nothing");
  command->add_flag("--quiet", options->quiet, "no progress on standard error");
  command->footer(
      "Examples:\n"
      "  hysteron bench bench/studies/quick.toml --out out\n"
      "  hysteron bench study.toml --out part2 --shard 2/8\n"
      "  mpirun -n 64 hysteron bench study.toml --out out\n"
      "Ctrl-C keeps the finished runs; the same command continues.");
  command->callback([options] {
    refuse_standard_output(options->out, "the records of a study");
    if (!options->dry) refuse_other_results(options->out, "store.sqlite");
    add_solver_commands(options->solver_commands);
    if (!options->solver_commands.empty()) {
      std::vector<std::string> solvers;
      for (const SolverSpec& solver : read_study_file(options->study).solvers) solvers.push_back(solver.id);
      refuse_unused_commands(options->solver_commands, solvers, "in the study a solver ");
    }
    RunOptions run;
    run.threads = options->threads;
    if (!options->shard.empty()) {
      const Shard shard = parse_shard(options->shard);
      run.shard_index = shard.index;
      run.shard_count = shard.count;
    }
    const auto started = launched();
    if (started && (started->size > 1 || built_with_mpi()) && !options->dry) {
      run_together(options->study, options->out, run, options->quiet);
      return;
    }
    const Plan plan = make_plan(read_study_file(options->study), HYSTERON_VERSION);
    if (!started || started->rank == 0) tell(plan.remarks);
    if (options->dry) {
      if (started && started->rank > 0) return;
      std::size_t own = 0;
      double evaluations = 0.0;
      for (const PlannedRun& one : plan.runs) {
        if (!in_shard(one.key, run.shard_index, run.shard_count)) continue;
        ++own;
        evaluations += static_cast<double>(one.budget);
      }
      fmt::print("{} runs of {}, at most {:.0f} evaluations; {} problems, {} solvers, {} budgets, {} seeds\n", own,
                 plan.runs.size(), evaluations, plan.problems.size(), plan.study.solvers.size(),
                 plan.study.budgets.size(), plan.study.seeds.size());
      return;
    }
    Store store = Store::open(options->out, Store::Mode::write);
    absorb_ranks(store, options->out);
    const RunProgress progress = run_with_progress(plan, store, run, options->quiet);
    if (tell_interrupted(progress, options->out)) return;
    conclude(plan, store, progress, run, options->out, options->quiet);
  });
}

}  // namespace hysteron::app
