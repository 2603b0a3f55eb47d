#include "external/external_solver.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "external/answers.hpp"
#include "external/line_program.hpp"
#include "fit/solver.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

// Seeds that a double and a signed integer of 32 bits hold.
constexpr std::uint64_t seeds = std::uint64_t{1} << 31;

// Runs of a study end in several threads.
struct FailedEnds {
  std::mutex mutex;
  std::map<std::string, std::size_t> runs;
};

FailedEnds& failed_ends() {
  static FailedEnds ends;
  return ends;
}

void note_end(const std::string& id, const std::string& how) {
  if (how.empty()) return;
  FailedEnds& ends = failed_ends();
  const std::lock_guard lock(ends.mutex);
  ++ends.runs["solver '" + id + "': " + how];
}

class ExternalSolver final : public Solver {
 public:
  ExternalSolver(std::string id, const std::vector<std::string>& words, const Problem& problem)
      : id_(std::move(id)), dimension_(problem.dimension), program_(words) {
    json begin = {{"protocol", "hysteron.ask-tell/1"},
                  {"dimension", problem.dimension},
                  {"budget", problem.budget},
                  {"seed", problem.stream.child("external").below(seeds, 0)},
                  {"start", problem.start},
                  {"linear", problem.linear}};
    program_.write(begin.dump());
  }
  ExternalSolver(const ExternalSolver&) = delete;
  ExternalSolver& operator=(const ExternalSolver&) = delete;
  ExternalSolver(ExternalSolver&&) = delete;
  ExternalSolver& operator=(ExternalSolver&&) = delete;
  ~ExternalSolver() override { note_end(id_, program_.end()); }

  Request ask() override {
    if (!stopped_.empty() || !pending_.points.empty()) {
      return pending_;
    }
    SolverAnswer answer = solver_answer(program_.read(), id_, dimension_);
    stopped_ = std::move(answer.stop);
    pending_.points = std::move(answer.points);
    if (!stopped_.empty()) refuse_unread("nothing after its stop");
    return pending_;
  }

  void tell(const Request& /*request*/, const Response& response) override {
    pending_ = {};
    refuse_unread(R"(nothing before {"tell": [...]})");
    program_.write(json{{"tell", response.cost}}.dump());
  }

  [[nodiscard]] std::string stopped_because() const override { return stopped_; }

 private:
  // A line that nobody asked for would be taken for a later answer, or lost.
  void refuse_unread(const std::string& expected) {
    if (const std::optional<std::string> line = program_.unread()) {
      throw WorkError("solver '" + id_ + "' " + printed(*line) + " without being asked, expected " + expected);
    }
  }

  std::string id_;
  std::size_t dimension_;
  LineProgram program_;
  Request pending_;
  std::string stopped_;
};

// With what the views of the entry look at.
struct Added {
  std::string id;
  ExternalProgram program;
  std::string description;
  SolverEntry entry;
};

std::deque<Added>& added() {
  static std::deque<Added> rows;
  return rows;
}

}  // namespace

std::vector<std::string> take_failed_ends() {
  FailedEnds& ends = failed_ends();
  const std::lock_guard lock(ends.mutex);
  std::vector<std::string> result;
  for (const auto& [how, runs] : ends.runs) {
    result.push_back(runs == 1 ? how : how + ", in " + std::to_string(runs) + " runs");
  }
  ends.runs.clear();
  return result;
}

const ExternalProgram* external_program(std::string_view id) {
  const auto found = std::ranges::find(added(), id, &Added::id);
  return found == added().end() ? nullptr : &found->program;
}

void add_external_solver(const std::string& id, ExternalProgram program) {
  if (id.empty()) throw InputError("solver '" + program.words.front() + "' has no name, expected one of its own");
  const ExternalProgram* known = external_program(id);
  if (known != nullptr && *known == program) return;
  if (find_solver(id) != nullptr || find_solver_family(id) != nullptr) {
    throw InputError("solver '" + id + "' exists already, expected a name of its own");
  }
  Added& row = added().emplace_back();
  row.id = id;
  row.description = "A program of the user's own:";
  for (const std::string& word : program.words) row.description += " " + word;
  row.program = std::move(program);
  row.entry.id = row.id;
  row.entry.title = row.id;
  row.entry.reference = "asked for points by lines of JSON, see docs/own-solver.md";
  row.entry.description = row.description;
  row.entry.make = [&row](const Problem& problem) -> std::unique_ptr<Solver> {
    return std::make_unique<ExternalSolver>(row.id, row.program.words, problem);
  };
  add_solver(&row.entry);
}

}  // namespace hysteron
