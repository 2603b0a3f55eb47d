// hysteron profile: where the time of a fit goes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "fit/parallel.hpp"
#include "report/terminal.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

struct Options {
  DataOptions data;
  std::vector<std::string> models;
  std::vector<std::string> effects;
  std::vector<std::string> solvers{"multistart-lm"};
  std::size_t budget = 2000;
  std::string by_current;
  CommonOptions common;
  bool json = false;
};

double seconds_since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

// Of one solver's run, in s of wall time.
struct Times {
  double wall = 0.0;
  double simulation = 0.0;   // costs and windows without derivatives
  double derivatives = 0.0;  // simulation with derivatives
  double screening = 0.0;    // coarse simulation
  std::size_t evaluations = 0;

  [[nodiscard]] double evaluating() const { return simulation + derivatives + screening; }
  [[nodiscard]] double solver() const { return wall - evaluating(); }
};

Times timed(const Layout& layout, const std::vector<Recording>& recordings, const ObjectiveOptions& objective_with,
            const SolverEntry& entry, const Options& options) {
  ObjectiveOptions with = objective_with;
  with.stopped = [] { return interrupted(); };
  const Objective objective(layout, recordings, with);
  Problem problem;
  problem.dimension = layout.dimension();
  problem.budget = options.budget;
  problem.stream = Stream(options.common.seed).child(entry.id);
  problem.linear = layout.linear();
  problem.screening = true;
  objective.describe_data(problem);
  Times times;
  const Clock::time_point begun = Clock::now();
  const RunResult run = run_solver(entry, problem, [&](const Request& request) {
    const Clock::time_point asked = Clock::now();
    Response response = objective.evaluate(request);
    (request.screening     ? times.screening
     : request.derivatives ? times.derivatives
                           : times.simulation) += seconds_since(asked);
    return response;
  });
  times.wall = seconds_since(begun);
  times.evaluations = run.evaluations;
  return times;
}

// Of what the threads offered; none where there was no work.
std::optional<double> idle_share(const Times& alone, const Times& together, int threads) {
  const double offered = static_cast<double>(threads) * together.wall;
  if (alone.evaluations == 0 || !(offered > 0.0)) {
    return std::nullopt;
  }
  // The same work, so what one thread needs for it is what the team was busy.
  return std::max(0.0, 1.0 - (alone.evaluating() + together.solver()) / offered);
}

std::string words_of(const std::string& model, const std::string& solver, const Times& alone, const Times& together,
                     int threads, const std::optional<double>& idle, std::size_t budget) {
  if (alone.evaluations == 0) {
    return wrapped(
        fmt::format("{}, {}: no evaluation, since the first that the solver asks for counts as more than the "
                    "budget of {}",
                    model, solver, budget),
        2);
  }
  const auto share = [&](double part) { return fmt::format("{:.1f}", 100.0 * part / alone.wall); };
  std::string text = fmt::format("{}, {}: {} evaluations, {} us each\n", model, solver, alone.evaluations,
                                 format_number(1e6 * alone.evaluating() / static_cast<double>(alone.evaluations), 3));
  text +=
      fmt::format("  1 thread: {} s, of which solver {} %, simulation {} %,\n    derivatives {} %, screening {} %\n",
                  format_number(alone.wall, 3), share(alone.solver()), share(alone.simulation),
                  share(alone.derivatives), share(alone.screening));
  if (threads > 1 && idle) {
    text += fmt::format("  {} threads: {} s, idle {:.1f} %\n", threads, format_number(together.wall, 3), 100.0 * *idle);
  }
  return text;
}

void run(const Options& options) {
  DataOptions data = options.data;
  data.taken = recordings_alone;
  data.taken.model = options.models.empty();
  const Campaign campaign =
      data.data.empty() ? find_dataset("rd8040-twin")->generate(Stream(1).child("rd8040-twin")) : load(data);
  std::vector<std::string> models = options.models;
  if (models.empty()) {
    models.push_back(campaign.model.empty() ? "bouc-wen" : campaign.model);
  }
  ObjectiveOptions objective = objective_options(options.common);
  const int threads = team_size(options.common.threads);
  LayoutOptions layout_with;
  layout_with.by_current = parse_orders("--by-current", options.by_current);
  json rows = json::array();
  std::string text;
  for (const std::string& id : options.solvers) {
    if (find_solver(id) == nullptr) {
      std::vector<std::string> known;
      for (const SolverEntry* one : solver_catalogue()) {
        known.emplace_back(one->id);
      }
      throw InputError("unknown solver '" + id + "'" + suggestion(id, known) + ", see `hysteron list solvers`");
    }
  }
  for (const std::string& name : models) {
    const Layout layout(make_model(name, options.effects), scale_of(campaign.recordings), layout_with);
    for (const std::string& id : options.solvers) {
      const SolverEntry& entry = *find_solver(id);
      objective.threads = 1;
      const Times alone = timed(layout, campaign.recordings, objective, entry, options);
      objective.threads = threads;
      const Times together = threads == 1 ? alone : timed(layout, campaign.recordings, objective, entry, options);
      if (interrupted()) {
        return;
      }
      const std::optional<double> idle = idle_share(alone, together, threads);
      text += words_of(name, id, alone, together, threads, idle, options.budget);
      rows.push_back(
          {{"model", name},
           {"solver", id},
           {"evaluations", alone.evaluations},
           {"one_thread",
            {{"wall_s", alone.wall},
             {"solver_s", alone.solver()},
             {"simulation_s", alone.simulation},
             {"derivatives_s", alone.derivatives},
             {"screening_s", alone.screening}}},
           {"team", {{"threads", threads}, {"wall_s", together.wall}, {"idle_share", idle ? json(*idle) : json()}}}});
    }
  }
  if (options.json) {
    fmt::print("{}", json_text({{"schema", "hysteron.profile/1"}, {"budget", options.budget}, {"rows", rows}}));
    return;
  }
  std::string notes;
  const auto any = [&](const auto& has) { return std::ranges::any_of(rows, has); };
  if (threads > 1 && any([](const json& row) { return row["team"]["idle_share"].is_number(); })) {
    notes += "Idle is what the threads offered and did not use. ";
  }
  if (any([](const json& row) { return row["one_thread"]["derivatives_s"].get<double>() > 0.0; })) {
    notes += "An evaluation with derivatives counts as 1 + number of parameters.";
  }
  fmt::print("{}{}", text, notes.empty() ? "" : "\n" + wrapped(notes));
}

}  // namespace

void add_profile(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("profile", "where the time of a fit goes: solver, simulation, idle threads");
  command->add_option("DATA", options->data.data, "recordings, or folders of them; default the dataset rd8040-twin");
  add_reading_options(*command, options->data);
  command->add_option("--model", options->models, "damper laws, one after the other; default that of the data")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--effects", options->effects, "effects put behind the laws")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--solver", options->solvers, "solvers, one after the other")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("--by-current", options->by_current,
                      "parameters that are polynomials in the drive, e.g. alpha:1");
  command->add_option("--budget", options->budget, "evaluations each solver may use")
      ->transform(whole_number(1, 1000000000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "JSON on standard output");
  add_common_options(*command, options->common);
  command->footer(
      "Examples:\n"
      "  hysteron profile\n"
      "  hysteron profile recordings/ --model bouc-wen,lugre --solver pso,multistart-lm --budget 5000");
  command->callback([options, command] {
    if (options->data.data.empty()) refuse_reading_options(*command, "DATA");
    run(*options);
  });
}

}  // namespace hysteron::app
