// hysteron minimise: the solvers on an objective of the user's own, a program that is told points and answers with
// their costs, by lines of JSON (docs/own-solver.md).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "external/answers.hpp"
#include "external/cost_range.hpp"
#include "external/line_program.hpp"
#include "fit/driver.hpp"
#include "report/terminal.hpp"
#include "task/solver_settings.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

struct Options {
  std::string objective;
  std::vector<std::string> box;  // NAME=LOWER:UPPER
  std::vector<std::string> solvers{"cma-es"};
  std::vector<std::string> settings;
  std::size_t budget = 1000;
  std::uint64_t seed = 1;
  std::string out;
  bool quiet = false;
};

struct Coordinate {
  std::string name;
  double lower = 0.0;
  double upper = 1.0;

  [[nodiscard]] double at(double unit) const { return lower + unit * (upper - lower); }
};

std::vector<Coordinate> box_of(const std::vector<std::string>& words) {
  std::vector<Coordinate> result;
  for (const std::string& word : words) {
    const auto [name, range] = split_pair("--box", word, "NAME=LOWER:UPPER, e.g. stiffness=0:1e5");
    const auto [lower, upper] = parse_range("--box", range);
    if (std::ranges::find(result, name, &Coordinate::name) != result.end()) {
      throw InputError("--box: '" + name + "' is given twice, expected each once");
    }
    result.push_back({name, lower, upper});
  }
  return result;
}

// A solver tells by what it asks, once it knows the cost of its first points, that it follows recordings in time. No
// more than so many points are asked for.
bool follows_recordings(const SolverEntry& entry) {
  constexpr std::size_t first_answers = 2;
  Problem problem;
  problem.dimension = 2;
  problem.budget = 1000;
  problem.linear.assign(problem.dimension, false);
  const std::unique_ptr<Solver> solver = entry.make(problem);
  for (std::size_t k = 0; k < first_answers; ++k) {
    const Request request = solver->ask();
    if (request.window) return true;
    if (request.points.empty()) return false;
    Response response;
    response.cost.assign(request.points.size() / problem.dimension, 1.0);
    solver->tell(request, response);
  }
  return false;
}

bool works_on_costs(const SolverEntry& entry) { return !entry.uses_derivatives && !follows_recordings(entry); }

// "cma-es, de, ... or nlopt:* without derivatives": a family is named as one.
std::string solvers_on_costs() {
  std::vector<std::string> names;
  std::vector<std::string> families;
  std::vector<const SolverEntry*> members;
  for (const SolverEntry* file : solver_files()) {
    if (file->members == nullptr) continue;
    const std::span<const SolverEntry* const> family = file->members();
    std::ranges::copy(family, std::back_inserter(members));
    const auto suits = [](const SolverEntry* member) { return works_on_costs(*member); };
    if (std::ranges::any_of(family, suits)) families.push_back(std::string(file->id) + " without derivatives");
  }
  for (const SolverEntry* entry : solver_catalogue()) {
    if (std::ranges::find(members, entry) == members.end() && works_on_costs(*entry)) names.emplace_back(entry->id);
  }
  names.insert(names.end(), families.begin(), families.end());
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

const SolverEntry& solver_of(const std::string& id) {
  const SolverEntry* entry = find_solver(id);
  if (entry == nullptr) {
    std::vector<std::string> known;
    for (const SolverEntry* one : solver_catalogue()) known.emplace_back(one->id);
    throw InputError("--solver: unknown solver '" + id + "'" + suggestion(id, known) + ", see `hysteron list solvers`");
  }
  if (entry->uses_derivatives) {
    throw InputError("--solver: '" + id + "' asks for derivatives, which a program does not give, expected " +
                     solvers_on_costs());
  }
  if (follows_recordings(*entry)) {
    throw InputError("--solver: '" + id + "' follows recordings in time, which an objective has none of, expected " +
                     solvers_on_costs());
  }
  return *entry;
}

// The user's program.
class Objective {
 public:
  Objective(const std::string& command, const std::vector<Coordinate>& box)
      : box_(box), program_(words_of_command(command)) {
    json begin = {{"protocol", "hysteron.evaluate/1"}, {"parameters", json::array()}};
    for (const Coordinate& one : box) {
      begin["parameters"].push_back({{"name", one.name}, {"lower", one.lower}, {"upper", one.upper}});
    }
    program_.write(begin.dump());
  }

  Response evaluate(const Request& request) {
    // Of an added solver that shows it late.
    if (request.derivatives || request.window) {
      throw InputError("--solver: this one asks for more than costs, expected " + solvers_on_costs());
    }
    const std::size_t d = box_.size();
    json points = json::array();
    for (std::size_t k = 0; k < request.points.size(); k += d) {
      json row = json::array();
      for (std::size_t c = 0; c < d; ++c) row.push_back(box_[c].at(request.points[k + c]));
      points.push_back(std::move(row));
    }
    refuse_unread();
    program_.write(json{{"evaluate", points}}.dump());
    Response response;
    for (const std::optional<double>& cost : objective_answer(program_.read(), points.size())) {
      response.cost.push_back(cost ? range_.told(*cost) : diverged_cost);
    }
    return response;
  }

  // WorkError where the program has printed what nobody asked for: the answers before it may be to other questions.
  void refuse_unread() {
    if (const std::optional<std::string> line = program_.unread()) {
      throw WorkError("the objective " + printed(*line) + " without being asked, expected one line for each question");
    }
  }

  // Of a whole run. How the program ended, where that was not well.
  std::string end() {
    refuse_unread();
    return program_.end();
  }

  // The program's own value of the lowest cost of a run, now or at an improvement; none where no point had one.
  [[nodiscard]] std::optional<double> value_of(double cost) const {
    return cost < diverged_cost ? std::optional(range_.value_of(cost)) : std::nullopt;
  }

 private:
  const std::vector<Coordinate>& box_;
  LineProgram program_;
  CostRange range_;
};

json record_of(const RunResult& run, const Objective& objective, const std::vector<Coordinate>& box) {
  json parameters = json::object();
  for (std::size_t c = 0; c < run.best.size(); ++c) parameters[box[c].name] = box[c].at(run.best[c]);
  json trace = json::array();
  for (const TracePoint& point : run.trace) {
    if (const auto value = objective.value_of(point.best)) trace.push_back({point.evaluations, *value});
  }
  const std::optional<double> cost = objective.value_of(run.cost);
  const bool found = !run.best.empty() && cost;
  return {{"solver", run.solver},
          {"cost", found ? json(*cost) : json()},
          {"parameters", found ? parameters : json::object()},
          {"evaluations", run.evaluations},
          {"without_cost", run.diverged},
          {"stopped", run.stopped()},
          {"trace", trace}};
}

std::string cost_text(const std::optional<double>& cost, int digits) {
  return cost ? fmt::format("{:.{}g}", *cost, digits) : std::string("none");
}

void run(const Options& options) {
  refuse_inputs(options.out, words_of_command(options.objective));
  const std::vector<Coordinate> box = box_of(options.box);
  refuse_repeats(Option::solver, options.solvers);
  std::vector<const SolverEntry*> entries;
  for (const std::string& id : options.solvers) entries.push_back(&solver_of(id));
  const std::map<std::string, double> settings = settings_of(options.settings);
  check_settings(Option::set, entries, settings);
  json record = {{"schema", "hysteron.minimum/1"},
                 {"command", command_line()},
                 {"seed", options.seed},
                 {"budget", options.budget},
                 {"runs", json::array()}};
  std::vector<std::string> head{"solver", "cost", "evaluations"};
  for (const Coordinate& one : box) head.push_back(one.name);
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> warnings;
  bool found = false;
  ProgressLine progress(options.quiet);
  for (const SolverEntry* entry : entries) {
    Objective objective(options.objective, box);
    Problem problem;
    problem.dimension = box.size();
    problem.budget = options.budget;
    problem.linear.assign(box.size(), false);
    // Without the solver's name: solvers that draw a first population alike draw the same one.
    problem.stream = Stream(options.seed).child("minimise");
    for (const auto& [name, value] : settings) {
      if (find_setting(*entry, name) != nullptr) problem.settings[name] = value;
    }
    const RunResult result = run_solver(
        *entry, problem, [&](const Request& request) { return objective.evaluate(request); },
        [&](const RunResult& now) {
          progress.show(std::string(entry->id), static_cast<double>(now.evaluations) / static_cast<double>(now.budget),
                        fmt::format("{} of {} evaluations, best {}", now.evaluations, now.budget,
                                    cost_text(objective.value_of(now.cost), 6)));
          return !interrupted();
        });
    progress.finish();
    // An interrupted program may owe an answer, and was interrupted itself.
    if (result.ended_by != EndedBy::interruption) {
      const std::string how = objective.end();
      if (!how.empty()) warnings.push_back(fmt::format("the objective, asked by {}: {}", result.solver, how));
    }
    record["runs"].push_back(record_of(result, objective, box));
    const json& parameters = record["runs"].back()["parameters"];
    std::vector<std::string> row{result.solver, cost_text(objective.value_of(result.cost), 9),
                                 std::to_string(result.evaluations)};
    for (const Coordinate& one : box) {
      row.push_back(parameters.empty() ? "" : fmt::format("{:.9g}", parameters.at(one.name).get<double>()));
    }
    rows.push_back(std::move(row));
    found = found || !parameters.empty();
    if (interrupted()) break;
  }
  if (!options.out.empty()) write_result(options.out, json_text(record));
  say_beside(options.out, table(head, rows));
  warn_of(warnings);
  if (!found) throw WorkError("the objective gave no point a cost");
}

}  // namespace

void add_minimise(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("minimise", "the solvers on an objective of your own, a program in any language");
  command
      ->add_option("--objective", options->objective,
                   "program that reads points and prints their costs, see docs/own-solver.md")
      ->required();
  command->add_option("--box", options->box, "NAME=LOWER:UPPER of each parameter")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--solver", options->solvers, "solvers, compared when several")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("--budget", options->budget, "evaluations each solver may use")
      ->transform(whole_number(1, 1000000000))
      ->capture_default_str();
  command->add_option("--set", options->settings, "SETTING=NUMBER of the solver; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--seed", options->seed, "seed of every random stream")
      ->transform(seed_number())
      ->capture_default_str();
  command->add_option("--out", options->out, "JSON file to write; -: standard output");
  command->add_flag("--quiet", options->quiet, "no progress on standard error");
  command->footer(
      "Example:\n  hysteron minimise --objective \"python3 examples/solver/objective.py\" --box x=-2:2,y=-1:3 "
      "--solver cma-es,pso --budget 2000");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app
