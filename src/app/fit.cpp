// hysteron fit: identifies one parameter set over recordings, writes model.json, fit.json and report.html.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "app/finite.hpp"
#include "app/model_file.hpp"
#include "app/page.hpp"
#include "app/result.hpp"
#include "app/stages.hpp"
#include "app/track.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "core/unit_text.hpp"
#include "fit/usable.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "report/terminal.hpp"
#include "respond/refine.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

struct FitOptions {
  DataOptions data;
  CommonOptions common;
  std::string model;
  std::vector<std::string> solvers;
  std::vector<std::string> solver_commands;  // NAME=COMMAND
  std::vector<std::string> effects;
  std::size_t budget = 20000;
  std::string by_current;
  std::string by_frequency;
  std::string stages = "one";
  std::vector<std::string> fix;
  std::vector<std::string> bounds;
  std::vector<std::string> settings;
  std::string out;
  bool response = false;  // recordings of a mass on the damper
  Rig rig;
  std::string interpolation = "cubic";
};

IdentifyOptions identify_options(const FitOptions& options, const Campaign& campaign) {
  IdentifyOptions result;
  add_solver_commands(options.solver_commands);
  refuse_repeats("--solver", options.solvers);
  refuse_repeats("--effects", options.effects);
  if (!options.solvers.empty()) {
    result.solvers = options.solvers;
  }
  result.budget = options.budget;
  result.seed = options.common.seed;
  result.effects = options.effects;
  result.objective = objective_options(options.common);
  result.objective.stopped = [] { return interrupted(); };
  result.layout.by_current =
      options.by_current.empty() ? campaign.by_current : parse_orders("--by-current", options.by_current);
  result.layout.by_frequency =
      options.by_frequency.empty() ? campaign.by_frequency : parse_orders("--by-frequency", options.by_frequency);
  for (const std::string& text : options.fix) {
    const auto [name, value] = split_pair("--fix", text, "PARAMETER=VALUE in SI units");
    if (!result.layout.fix.emplace(name, parse_number("--fix", value)).second) {
      throw InputError("--fix: '" + name + "' is given twice, expected each parameter once");
    }
  }
  for (const std::string& text : options.bounds) {
    const auto [name, range] = split_pair("--bounds", text, "PARAMETER=LOWER:UPPER in SI units");
    const auto [lower, upper] = parse_range("--bounds", range);
    if (!result.layout.bounds.emplace(name, std::pair(lower, upper)).second) {
      throw InputError("--bounds: '" + name + "' is given twice, expected each parameter once");
    }
  }
  result.settings = settings_of(options.settings);
  return result;
}

json trace_json(const RunResult& run) {
  json trace = json::array();
  for (const TracePoint& point : run.trace) {
    if (point.best < diverged_cost) {
      trace.push_back({point.evaluations, point.best});
    }
  }
  return trace;
}

json solver_json(const Identification& result, const Campaign& campaign, std::size_t k) {
  const SolverOutcome& outcome = result.solvers[k];
  std::vector<const Recording*> followed;
  for (const std::size_t index : result.compared_on(campaign.recordings.size())) {
    followed.push_back(&campaign.recordings[index]);
  }
  return {{"id", outcome.run.solver},
          {"title", find_solver(outcome.run.solver)->title},
          {"cost", outcome.run.cost},
          {"nrmse_heldout", outcome.nrmse_heldout ? json(*outcome.nrmse_heldout) : json(nullptr)},
          {"evaluations", outcome.run.evaluations},
          {"budget", outcome.run.budget},
          {"diverged", outcome.run.diverged},
          {"stopped", outcome.run.stopped},
          {"chosen", k == result.chosen},
          {"trace", trace_json(outcome.run)},
          {"track", track_json(outcome.run, result.layout, followed)}};
}

json final_json(const Identification& result) {
  if (!result.final_run) {
    return nullptr;
  }
  const RunResult& run = *result.final_run;
  return {{"stage", result.final_stage},    {"solver", run.solver}, {"cost", run.cost},
          {"evaluations", run.evaluations}, {"budget", run.budget}, {"stopped", run.stopped}};
}

json response_json(const ResponseFit& fit, const Rig& rig, const std::string& interpolation) {
  const auto finite = [](double value) { return std::isfinite(value) && value < diverged_cost ? json(value) : json(); };
  json rows = json::array();
  for (const ResponseScore& score : fit.scores) {
    rows.push_back({{"file", score.file}, {"nrmse", finite(score.nrmse)}, {"rmse_m", finite(score.rmse)}});
  }
  return {{"mass_kg", rig.mass},
          {"stiffness_n_per_m", rig.stiffness},
          {"damping_n_s_per_m", rig.damping},
          {"interpolation", interpolation},
          {"nrmse_of_equation_of_motion", finite(fit.before)},
          {"nrmse", finite(fit.cost)},
          {"evaluations", fit.run.evaluations},
          {"stopped", fit.run.stopped},
          {"recordings", rows}};
}

void run(const FitOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<std::string> remarks;
  Campaign campaign = load(options.data, options.response ? Required::motion : Required::motion_and_force, &remarks);
  require_usable(campaign.recordings, options.response ? ForceOf::excitation : ForceOf::damper);
  Rig rig = options.rig;
  rig.interpolation = interpolation_of(options.interpolation);
  std::vector<Recording> responses;  // the motion under the force on the mass; `campaign` is the damper's own then
  if (options.response) {
    responses = std::move(campaign.recordings);
    campaign.recordings = damper_recordings(responses, rig);
  }
  const std::string model = options.model.empty() ? campaign.model : options.model;
  if (model.empty()) {
    throw InputError("no model: expected --model NAME or a model in campaign.toml, see `hysteron list models`");
  }
  const IdentifyOptions identify_with = identify_options(options, campaign);
  // Wrong names are told before a folder is made.
  make_model(model, identify_with.effects);
  normaliser(campaign.recordings.front(), identify_with.objective.normalisation);
  if (options.stages == "two" && identify_with.layout.by_current.empty() && identify_with.layout.by_frequency.empty()) {
    throw InputError("--stages two: no parameter has a law, expected --by-current or --by-frequency");
  }

  if (options.stages == "two" && options.response) {
    throw InputError("--stages two: values of conditions are not fitted to a response, expected one stage");
  }

  const bool to_files = !is_standard_output(options.out);
  if (to_files) {
    check_output_folder(options.out);
  }

  ProgressLine progress(options.common.quiet);
  const auto show = [&](const std::string& stage, const RunResult& run) {
    progress.show(stage, static_cast<double>(run.evaluations) / static_cast<double>(run.budget),
                  fmt::format("{} of {} evaluations, best NRMSE {}", run.evaluations, run.budget,
                              run.cost < diverged_cost ? format_number(run.cost, 4) : "-"));
    return !interrupted();
  };
  Identification result = identify(campaign, model, identify_with, show);
  std::optional<ResponseFit> response;
  if (options.response && !interrupted()) {
    response = refine(result, responses, rig, identify_with, [&](const RunResult& run) {
      progress.show("lm: motion of the mass", static_cast<double>(run.evaluations) / static_cast<double>(run.budget),
                    fmt::format("{} of {} evaluations, best NRMSE of the displacement {}", run.evaluations, run.budget,
                                run.cost < diverged_cost ? format_number(run.cost, 4) : "-"));
      return !interrupted();
    });
    result.cost = predicted_nrmse(result.layout, result.terms, refer_to(campaign.recordings, result.fitted),
                                  identify_with.objective);
    if (result.roles_given && !result.heldout.empty()) {
      result.nrmse_heldout = predicted_nrmse(result.layout, result.terms, refer_to(campaign.recordings, result.heldout),
                                             identify_with.objective);
    }
  }
  // An error that is not finite is none; the recordings it comes from are named below.
  const auto drop_if_not_finite = [](std::optional<double>& error) {
    if (error && !std::isfinite(*error)) error.reset();
  };
  drop_if_not_finite(result.nrmse_heldout);
  for (SolverOutcome& outcome : result.solvers) drop_if_not_finite(outcome.nrmse_heldout);
  std::optional<TwoStage> two;
  if (options.stages == "two" && !interrupted()) {
    try {
      two = fit_two_stage(campaign, result.layout, result.compared_on(campaign.recordings.size()), result.heldout,
                          *find_solver(result.solvers[result.chosen].run.solver), identify_with, show);
    } catch (const Stopped&) {
      two.reset();
    }
  }
  progress.finish();
  if (to_files) {
    make_output_folder(options.out);
  }

  std::vector<bool> held_out(campaign.recordings.size(), false);
  for (const std::size_t k : result.heldout) held_out[k] = true;
  const auto role = [&](std::size_t k) { return std::string(held_out[k] && result.roles_given ? "validate" : "fit"); };
  const auto shown_role = [&](std::size_t k) { return held_out[k] && !result.roles_given ? "checked" : role(k); };

  // One prediction at a time: it is as long as its recording.
  std::vector<Score> scores;
  std::string diverged;
  json page_recordings = json::array();
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const Recording& recording = campaign.recordings[k];
    const Target target = make_target(recording, identify_with.objective);
    Prediction prediction;
    prediction.force = predict(result.layout.model(), result.layout.held(), result.terms, target);
    prediction.score = score(prediction.force, recording, identify_with.objective.normalisation);
    if (const auto time = diverges_at(prediction.force, recording)) {
      diverged += fmt::format("{}{} from {:g} s on", diverged.empty() ? "" : ", ", recording.file, *time);
    }
    page_recordings.push_back(recording_json(recording, prediction, shown_role(k), campaign.recordings.size()));
    scores.push_back(prediction.score);
  }

  const std::string normalisation(word_of(identify_with.objective.normalisation));
  json warnings = remarks;
  for (const std::string& warning : result.warnings) {
    warnings.push_back(warning);
  }
  if (interrupted()) {
    warnings.push_back("interrupted: the solvers did not use their whole budget");
  }
  if (!diverged.empty()) {
    diverged = "the simulation of the fitted model does not stay finite: " + diverged;
    warnings.push_back(diverged);
  }
  json heldout_files = json::array();
  for (const std::size_t k : result.heldout) {
    heldout_files.push_back(campaign.recordings[k].file);
  }
  constexpr std::size_t most_named = 20;
  std::string heldout_names;
  for (std::size_t k = 0; k < std::min(most_named, result.heldout.size()); ++k) {
    heldout_names += (k > 0 ? ", " : "") + campaign.recordings[result.heldout[k]].file;
  }
  if (result.heldout.size() > most_named) {
    heldout_names += fmt::format(" and {} more", result.heldout.size() - most_named);
  }

  const json model_file = model_json(result, campaign, identify_with);
  json rows = json::array();
  json data = json::array();
  for (std::size_t k = 0; k < scores.size(); ++k) {
    rows.push_back({{"file", campaign.recordings[k].file},
                    {"role", role(k)},
                    {"held_out_in_check", held_out[k]},
                    {"nrmse", scores[k].nrmse},
                    {"rmse_n", scores[k].rmse},
                    {"fit_percent", scores[k].fit_percent}});
    data.push_back({{"file", campaign.recordings[k].file}, {"sha256", campaign.recordings[k].sha256}});
  }
  json solvers = json::array();
  for (std::size_t k = 0; k < result.solvers.size(); ++k) {
    solvers.push_back(solver_json(result, campaign, k));
  }
  json estimates = json::array();
  for (const Estimate& estimate : result.estimates) {
    estimates.push_back(estimate_json(estimate, result.layout));
  }
  const json fit_file = {
      {"schema", "hysteron.fit/1"},
      {"model", model_file["model"]},
      {"effects", model_file["effects"]},
      {"normalisation", normalisation},
      {"weighting", options.common.weighting},
      {"nrmse", model_file["nrmse"]},
      {"held_out", heldout_files},
      {"held_out_by", result.roles_given ? "campaign.toml" : "the program; final fit uses all recordings"},
      {"solvers", solvers},
      {"final", final_json(result)},
      {"parameters", estimates},
      {"recordings", rows},
      {"stages", two ? stages_json(*two, result, campaign) : json(nullptr)},
      {"response", response ? response_json(*response, rig, options.interpolation) : json(nullptr)},
      {"warnings", warnings},
      {"provenance", model_file["provenance"]}};

  json page = fit_file;
  page["title"] = "Identification of " + std::string(result.layout.model().law->title);
  page["subtitle"] =
      fmt::format("{} recordings, {} free parameters", campaign.recordings.size(), result.layout.dimension());
  page["version"] = HYSTERON_VERSION;
  page["command"] = command_line();
  page["seed"] = options.common.seed;
  std::vector<std::string> equations(result.layout.model().law->equations.begin(),
                                     result.layout.model().law->equations.end());
  for (const Part* effect : result.layout.model().effects) {
    equations.insert(equations.end(), effect->equations.begin(), effect->equations.end());
  }
  page["model"] = {{"id", result.layout.model().law->id},
                   {"title", result.layout.model().law->title},
                   {"equations", equations},
                   {"reference", result.layout.model().law->reference}};
  page["summary"] = json::array();
  if (response) {
    page["summary"].push_back({{"label", "NRMSE, displacement of the mass"},
                               {"value", format_number(response->cost, 3)},
                               {"note",
                                "simulated motion; forces on this page are of the equation of motion, with the "
                                "noise of its acceleration"}});
  }
  page["summary"].push_back(
      {{"label", response ? "NRMSE, force of the equation of motion" : "NRMSE, fitted recordings"},
       {"value", format_number(result.cost, 3)},
       {"note", "root mean square over recordings, normalised by " + normalisation}});
  if (result.nrmse_heldout) {
    page["summary"].push_back({{"label", "NRMSE, held-out recordings"},
                               {"value", format_number(*result.nrmse_heldout, 3)},
                               {"note", "fitted without " + heldout_names}});
  }
  page["summary"].push_back(
      {{"label", "Evaluations"},
       {"value", std::to_string(result.solvers[result.chosen].run.evaluations)},
       {"note", result.solvers[result.chosen].run.solver + ": " + result.solvers[result.chosen].run.stopped +
                    (result.final_run ? fmt::format("; and {} in the {} by {}", result.final_run->evaluations,
                                                    result.final_stage, result.final_run->solver)
                                      : "")}});
  page["recordings"] = std::move(page_recordings);
  page["data"] = data;
  page["notes"] = {
      "Standard errors come from the curvature at the optimum with the effective sample size of the "
      "correlated residual; they do not cover what the model leaves out.",
      "Fit [%] = 100 (1 - RMSE / standard deviation of the measured force).",
      "A derivative evaluation is charged as 1 + number of free parameters evaluations."};
  if (std::ranges::any_of(result.solvers, [](const SolverOutcome& outcome) { return !outcome.run.track.empty(); })) {
    page["notes"].push_back(
        "Bands of parameters against time are the filter's own: they hold as far as the model and its noise level do.");
  }
  page["diagnosis"] = nullptr;

  const std::filesystem::path out(options.out);
  if (to_files) {
    write_file_atomically(out / "model.json", json_text(model_file));
    write_file_atomically(out / "fit.json", json_text(fit_file));
    write_file_atomically(out / "report.html", fit_report_html(std::move(page)));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    write_file_atomically(out / "environment.json", json_text(environment(options.common.threads, seconds)));
  } else {
    write_result(options.out, json_text(model_file));
  }
  const auto say = [&](const std::string& text) { say_beside(options.out, text); };

  std::vector<std::vector<std::string>> table_rows;
  for (std::size_t k = 0; k < result.solvers.size(); ++k) {
    const SolverOutcome& outcome = result.solvers[k];
    table_rows.push_back({outcome.run.solver, format_number(outcome.run.cost, 4),
                          outcome.nrmse_heldout ? format_number(*outcome.nrmse_heldout, 4) : "-",
                          std::to_string(outcome.run.evaluations), std::to_string(outcome.run.diverged),
                          outcome.run.stopped});
  }
  say(fmt::format("{}\n",
                  narrow_table({"solver", "NRMSE fit", "held out", "evaluations", "diverged", "stopped"}, table_rows)));
  table_rows.clear();
  for (const Estimate& estimate : result.estimates) {
    std::string remark = estimate.at_bound ? "at " + *estimate.at_bound + " bound" : "";
    if (!estimate.identifiable) {
      remark += (remark.empty() ? "" : ", ") + std::string("not identifiable");
    }
    table_rows.push_back({estimate.name, format_number(estimate.term.value, 4),
                          estimate.std_error ? format_number(*estimate.std_error, 2) : "-", unit_text(estimate.unit),
                          remark});
  }
  say(fmt::format("{}\n", table({"parameter", "value", "std error", "unit", "remark"}, table_rows)));
  table_rows.clear();
  for (std::size_t k = 0; k < scores.size(); ++k) {
    table_rows.push_back({campaign.recordings[k].file, format_number(scores[k].nrmse, 4),
                          format_number(scores[k].rmse, 4), percent_text(scores[k].fit_percent),
                          held_out[k] ? (result.roles_given ? "validate" : "held out in the check") : ""});
  }
  say(fmt::format("{}\n", table({response ? "force of the equation of motion" : "recording", "NRMSE", "RMSE [N]",
                                 "fit [%]", "remark"},
                                table_rows)));
  if (response) {
    table_rows.clear();
    for (const ResponseScore& score : response->scores) {
      table_rows.push_back({score.file, format_number(score.nrmse, 4), format_number(1e3 * score.rmse, 4)});
    }
    say(fmt::format("{}\n", table({"motion of the mass", "NRMSE", "RMSE [mm]"}, table_rows)));
  }
  if (two) {
    say(stages_text(*two, result));
  }
  if (!result.heldout.empty() && !result.roles_given) {
    say(fmt::format("solvers compared on the {} other recordings; final fit on all {}\n",
                    campaign.recordings.size() - result.heldout.size(), campaign.recordings.size()));
  }
  if (result.final_run) {
    say(wrapped(fmt::format("{} by {}: {} further evaluations, {}", result.final_stage, result.final_run->solver,
                            result.final_run->evaluations, result.final_run->stopped),
                2));
  }
  if (response) {
    say(
        fmt::format("lm on the motion of the mass: NRMSE of the displacement {} after {} evaluations, {} with the "
                    "parameters of the equation of motion; {}\nforce of the equation of motion: ",
                    format_number(response->cost, 4), response->run.evaluations, format_number(response->before, 4),
                    response->run.stopped));
  }
  say(fmt::format("overall NRMSE {} ({} weighting, normalised by {})", format_number(result.cost, 4),
                  options.common.weighting, normalisation));
  if (result.nrmse_heldout) {
    say(fmt::format(",\n  {} on held-out recordings", format_number(*result.nrmse_heldout, 4)));
  }
  say(to_files ? fmt::format("\nreport: {}\n", (out / "report.html").string()) : std::string("\n"));
  // The remarks have been made when the recordings were read.
  for (std::size_t k = remarks.size(); k < warnings.size(); ++k) {
    fmt::print(stderr, "warning: {}\n", printable(warnings[k].get<std::string>()));
  }
  if (!diverged.empty()) {
    throw WorkError(diverged);
  }
}

}  // namespace

void add_fit(CLI::App& program) {
  auto options = std::make_shared<FitOptions>();
  CLI::App* command = program.add_subcommand("fit", "identifies one parameter set over all recordings given");
  add_data_options(*command, options->data);
  add_keep_option(*command, options->data);
  command->add_option("--model", options->model, "damper law, see `hysteron list models`");
  command->add_option("--effects", options->effects, "effects put behind the law, see `hysteron list effects`")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--solver", options->solvers, "solvers, compared when several; default multistart-lm")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_solver_option(*command, options->solver_commands);
  command->add_option("--budget", options->budget, "evaluations each solver may use")
      ->transform(whole_number(1, 1000000000))
      ->capture_default_str();
  command->add_option("--by-current", options->by_current,
                      "parameters that are polynomials in the drive, e.g. alpha:1,c0:1");
  command->add_option("--by-frequency", options->by_frequency, "parameters that are polynomials in frequency");
  command
      ->add_option("--stages", options->stages,
                   "two: also the laws through the values of conditions fitted freely, beside the joint fit")
      ->check(CLI::IsMember({"one", "two"}))
      ->capture_default_str();
  command->add_option("--fix", options->fix, "PARAMETER=VALUE held, SI units; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--bounds", options->bounds, "PARAMETER=LOWER:UPPER instead of the default box; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--set", options->settings, "SETTING=NUMBER of the solver; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  CLI::Option* response = command->add_flag(
      "--response", options->response,
      "the recordings are of a mass on the damper: its displacement, and the force on it (none: free decay)");
  command->add_option("--mass", options->rig.mass, "kg, with --response")
      ->needs(response)
      ->check(real_number(1e-9, 1e12));
  command->add_option("--stiffness", options->rig.stiffness, "N/m, of a spring beside the damper, with --response")
      ->needs(response)
      ->check(real_number(-1e15, 1e15));
  command->add_option("--damping", options->rig.damping, "N s/m, of a dashpot beside the damper, with --response")
      ->needs(response)
      ->check(real_number(-1e15, 1e15));
  command
      ->add_option("--interpolation", options->interpolation,
                   "of the force on the mass between its samples: linear, cubic, band-limited; with --response")
      ->check(CLI::IsMember({"linear", "cubic", "band-limited"}))
      ->needs(response);
  response->needs(command->get_option("--mass"));
  command
      ->add_option("--out", options->out,
                   "folder for model.json, fit.json, report.html; -: model.json on standard output")
      ->required();
  add_common_options(*command, options->common);
  command->footer(
      "Example:\n  hysteron fit recordings/ --model bouc-wen --by-current alpha:1,c0:1 --out out\n"
      "  hysteron fit recordings/ --model modified-bouc-wen --effects offset-force --solver pso,ga,multistart-lm --out "
      "out\n"
      "  hysteron fit shaker/ --response --mass 250 --stiffness 2e4 --model bouc-wen --out out\n"
      "  hysteron fit recordings/ --model bouc-wen --solver mine --solver-command \"mine=python3 mine.py\" --out out");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app
