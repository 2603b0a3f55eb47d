#include "external/external_solver.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "external/answers.hpp"
#include "external/line_program.hpp"
#include "fit/solver.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

// Seeds that a double and a signed integer of 32 bits hold.
constexpr std::uint64_t seeds = std::uint64_t{1} << 31;

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

  Request ask() override {
    if (!stopped_.empty() || !pending_.points.empty()) {
      return pending_;
    }
    SolverAnswer answer = solver_answer(program_.read(), id_, dimension_);
    stopped_ = std::move(answer.stop);
    pending_.points = std::move(answer.points);
    return pending_;
  }

  void tell(const Request& /*request*/, const Response& response) override {
    pending_ = {};
    program_.write(json{{"tell", response.cost}}.dump());
  }

  [[nodiscard]] std::string stopped_because() const override { return stopped_; }

 private:
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
