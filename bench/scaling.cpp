// How far the dispatch of `mpirun hysteron bench` carries: a discrete-event simulation with the program's own
// Dispatcher, run lengths of a finished study, and times of a question and of taking in the stores measured on it.
//   hysteron_scaling DIR --question S --record S --store S [--length S] [--study 1|2,...] workers...
// Prints a row of Markdown for every number of workers.
//
// The model: a rank does its batch, sends a question and waits. Questions reach the first rank after `latency` and are
// answered one at a time, `question` each; the first rank's own worker takes batches without a message. A run costs its
// length and `record` for storing it. When all have ended the first rank takes in the stores one after the other,
// `store` each and `row` for every run in it. Start-up is left out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <queue>

#include "core/random.hpp"
#include "study/dispatch.hpp"
#include "study/store.hpp"

namespace {

using namespace hysteron;

struct Costs {
  double question = 0.0;
  double latency = 0.0;
  double record = 0.0;
  double store = 0.0;
  double row = 0.0;
};

struct Work {
  std::vector<Assignment> todo;
  std::vector<double> length;  // by Assignment::run
};

// Runs of a finished study, each as often as asked; the lengths of the copies are drawn from runs of their kind.
Work read_work(const std::string& folder, std::size_t copies, double mean_length) {
  const Store store = Store::open(folder, Store::Mode::read);
  const auto plan = nlohmann::json::parse(store.plan().value());
  std::map<std::string, double> seconds;
  for (const RunTiming& timing : store.timings()) seconds[timing.key] = timing.seconds;
  Work work;
  std::map<std::size_t, std::vector<double>> of_kind;
  std::vector<Assignment> once;
  for (const auto& run : plan.at("runs")) {
    const auto found = seconds.find(run.at("key").get<std::string>());
    if (found == seconds.end()) continue;
    const auto problem = run.at("problem").get<std::size_t>();
    const auto budget = run.at("budget").get<std::size_t>();
    const std::size_t kind =
        (problem * plan.at("solvers").size() + run.at("solver").get<std::size_t>()) * 1000000 + budget;
    const double size = plan.at("problems").at(problem).at("samples").get<double>() * static_cast<double>(budget);
    of_kind[kind].push_back(found->second);
    once.push_back({once.size(), kind, size});
    work.length.push_back(found->second);
  }
  double sum = 0.0;
  for (const double one : work.length) sum += one;
  const double scale = mean_length > 0.0 ? mean_length * static_cast<double>(work.length.size()) / sum : 1.0;
  const Stream stream(1);
  work.todo = once;
  for (std::size_t copy = 1; copy < copies; ++copy) {
    for (const Assignment& one : once) {
      const auto& lengths = of_kind[one.kind];
      const double draw = stream.child("copy").uniform(work.todo.size());
      const auto pick =
          std::min(lengths.size() - 1, static_cast<std::size_t>(draw * static_cast<double>(lengths.size())));
      work.todo.push_back({work.todo.size(), one.kind, one.size});
      work.length.push_back(lengths[pick]);
    }
  }
  for (double& one : work.length) one *= scale;
  return work;
}

struct Outcome {
  double seconds = 0.0;    // until the last run has ended
  double gathering = 0.0;  // after it
  double serving = 0.0;    // of the first rank, answering
  double working = 0.0;    // sum of all run lengths
};

Outcome simulate(const Work& work, std::size_t workers, const Costs& costs) {
  Dispatcher dispatcher(work.todo, workers);
  struct Question {
    double at;
    std::size_t worker;
    bool operator>(const Question& other) const { return std::pair(at, worker) > std::pair(other.at, other.worker); }
  };
  std::priority_queue<Question, std::vector<Question>, std::greater<>> questions;
  std::vector<std::vector<std::size_t>> batches(workers);
  for (std::size_t k = 0; k < workers; ++k) questions.push({k == 0 ? 0.0 : costs.latency, k});
  Outcome outcome;
  double free = 0.0;  // when the first rank can answer again
  std::size_t stored = 0;
  while (!questions.empty()) {
    const Question question = questions.top();
    questions.pop();
    double now = question.at;
    if (question.worker != 0) {
      now = std::max(now, free) + costs.question;
      free = now;
      outcome.serving += costs.question;
    }
    for (const std::size_t run : batches[question.worker]) dispatcher.finished(run, work.length[run]);
    batches[question.worker] = dispatcher.take();
    if (batches[question.worker].empty()) continue;
    double spent = 0.0;
    for (const std::size_t run : batches[question.worker]) {
      spent += work.length[run] + costs.record;
      outcome.working += work.length[run];
      if (question.worker != 0) ++stored;
    }
    const double back = question.worker == 0 ? 0.0 : costs.latency;
    outcome.seconds = std::max(outcome.seconds, now + back + spent);
    questions.push({now + 2.0 * back + spent, question.worker});
  }
  outcome.gathering = static_cast<double>(workers - 1) * costs.store + static_cast<double>(stored) * costs.row;
  return outcome;
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App program{"efficiency of the dispatch against the number of workers, simulated"};
  std::string folder;
  Costs costs;
  std::size_t copies = 1;
  double mean_length = 0.0;
  std::vector<std::size_t> workers;
  program.add_option("DIR", folder, "a finished study")->required();
  program.add_option("workers", workers, "numbers of workers")->required();
  program.add_option("--question", costs.question, "s to answer one question")->required();
  program.add_option("--latency", costs.latency, "s of a message on its way")->required();
  program.add_option("--record", costs.record, "s to store a run")->required();
  program.add_option("--store", costs.store, "s to take in a store")->required();
  program.add_option("--row", costs.row, "s to take in a run")->required();
  program.add_option("--copies", copies, "runs of the study, so many times");
  program.add_option("--length", mean_length, "scale run lengths to this mean, s");
  CLI11_PARSE(program, count, arguments);
  const Work work = read_work(folder, copies, mean_length);
  for (const std::size_t n : workers) {
    const Outcome one = simulate(work, n, costs);
    const double all = static_cast<double>(n);
    fmt::print("| {} | {} | {:.3g} | {:.1f} | {:.1f} | {:.1f} | {:.3g} |\n", n, work.todo.size(), one.seconds,
               100.0 * one.working / (all * one.seconds), 100.0 * one.working / (all * (one.seconds + one.gathering)),
               100.0 * one.serving / one.seconds, one.gathering);
  }
}
