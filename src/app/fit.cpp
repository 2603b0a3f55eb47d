// hysteron fit: identifies one parameter set over recordings, writes model.json, fit.json and report.html.
#include "task/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/laws.hpp"
#include "app/option_name.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "report/terminal.hpp"
#include "task/finite.hpp"
#include "task/solver_settings.hpp"
#include "task/stages.hpp"

namespace hysteron::app {
namespace {

struct FitOptions {
  DataOptions data;
  CommonOptions common;
  std::string model;
  std::vector<std::string> solvers;
  std::vector<std::string> solver_commands;  // NAME=COMMAND
  std::vector<std::string> effects;
  std::size_t budget = 20000;
  LawOptions laws;
  std::string stages = "one";
  std::vector<std::string> fix;
  std::vector<std::string> bounds;
  std::vector<std::string> settings;
  std::string out;
  bool response = false;  // recordings of a mass on the damper
  Rig rig;
  std::string interpolation = "cubic";
  std::string excitation = "auto";
};

FitRequest request_of(const FitOptions& options) {
  FitRequest request;
  request.model = options.model;
  request.two_stages = options.stages == "two";
  if (options.response) {
    request.rig = options.rig;
    request.rig->interpolation = interpolation_of(options.interpolation);
    request.excitation = excites_of(options.excitation);
  }
  IdentifyOptions& result = request.identify;
  add_solver_commands(options.solver_commands);
  refuse_unused_commands(options.solver_commands, options.solvers, "--solver ");
  if (!options.solvers.empty()) {
    result.solvers = options.solvers;
  }
  result.budget = options.budget;
  result.seed = options.common.seed;
  result.effects = options.effects;
  result.objective = objective_options(options.common);
  result.objective.stopped = [] { return interrupted(); };
  set_laws(options.laws, result.layout);
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
  check_settings(Option::set, result.solvers, result.settings);
  return request;
}

// What is said on standard output.
void tell(const FitResult& fit, const FitData& data, const FitOptions& options) {
  const Identification& result = fit.identification;
  const Campaign& campaign = data.campaign;
  const auto say = [&](const std::string& text) { say_beside(options.out, text); };
  std::vector<std::vector<std::string>> table_rows;
  for (std::size_t k = 0; k < result.solvers.size(); ++k) {
    const SolverOutcome& outcome = result.solvers[k];
    table_rows.push_back({outcome.run.solver, format_number(outcome.run.cost, 4),
                          outcome.nrmse_heldout ? format_number(*outcome.nrmse_heldout, 4) : "-",
                          std::to_string(outcome.run.evaluations), std::to_string(outcome.run.diverged),
                          outcome.run.stopped()});
  }
  say(fmt::format("{}\n",
                  narrow_table({"solver", "NRMSE fit", "held out", "evaluations", "diverged", "stopped"}, table_rows)));
  table_rows.clear();
  for (const Estimate& estimate : result.estimates) {
    std::string remark = estimate.at_limit   ? "at its limit"
                         : estimate.at_bound ? fmt::format("at {} bound", word_of(*estimate.at_bound))
                                             : "";
    if (!estimate.identifiable) {
      remark += (remark.empty() ? "" : ", ") + std::string("not identifiable");
    }
    table_rows.push_back({estimate.name, format_number(estimate.term.value, 4),
                          estimate.std_error ? format_number(*estimate.std_error, 2) : "-", estimate.unit_text,
                          remark});
  }
  say(fmt::format("{}\n", table({"parameter", "value", "std error", "unit", "remark"}, table_rows)));
  if (!result.bounds_met.empty()) say(wrapped(printable(result.bounds_met.with(option_name))) + "\n");
  table_rows.clear();
  for (std::size_t k = 0; k < fit.scores.size(); ++k) {
    table_rows.push_back({campaign.recordings[k].file, format_number(fit.scores[k].nrmse, 4),
                          format_number(fit.scores[k].rmse, 4), percent_text(fit.scores[k].fit_percent),
                          fit.held_out[k] ? (result.roles_given ? "validate" : "held out in the check") : ""});
  }
  say(fmt::format("{}\n", table({fit.response ? "force of the equation of motion" : "recording", "NRMSE", "RMSE [N]",
                                 "fit [%]", "remark"},
                                table_rows)));
  if (fit.response) {
    table_rows.clear();
    for (const ResponseScore& score : fit.response->scores) {
      table_rows.push_back({score.file, format_number(score.nrmse, 4), format_number(1e3 * score.rmse, 4)});
    }
    say(fmt::format("{}\n", table({"motion of the mass", "NRMSE", "RMSE [mm]"}, table_rows)));
  }
  if (fit.two_stages) {
    say(stages_text(*fit.two_stages, result));
  }
  if (!result.heldout.empty() && !result.roles_given) {
    say(fmt::format("solvers compared on the {} other recordings; final fit on all {}\n",
                    campaign.recordings.size() - result.heldout.size(), campaign.recordings.size()));
  }
  if (result.final_run) {
    say(wrapped(fmt::format("{} by {}: {} further evaluations, {}", result.final_stage, result.final_run->solver,
                            result.final_run->evaluations, result.final_run->stopped()),
                2));
  }
  if (fit.response) {
    say(wrapped(fmt::format("lm on the motion of the mass: NRMSE of the displacement {} after {} evaluations, {} with "
                            "the parameters of the equation of motion; {}",
                            format_number(fit.response->cost, 4), fit.response->run.evaluations,
                            format_number(fit.response->before, 4), fit.response->run.stopped()),
                2));
    say("force of the equation of motion: ");
  }
  say(fmt::format("overall NRMSE {} ({} weighting, normalised by {})", format_number(result.cost, 4),
                  options.common.weighting, options.common.normalisation));
  if (result.nrmse_heldout) {
    say(fmt::format(",\n  {} on held-out recordings", format_number(*result.nrmse_heldout, 4)));
  }
  say(is_standard_output(options.out)
          ? std::string("\n")
          : fmt::format("\nreport: {}\n", printable((std::filesystem::path(options.out) / "report.html").string())));
}

void run(const FitOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<std::string> remarks;
  DataOptions from = options.data;
  ask_conditions(options.laws, from);
  from.taken.model = options.model.empty();
  Campaign campaign = load(from, options.response ? Required::motion : Required::motion_and_force, &remarks);
  FitRequest request = request_of(options);
  // Wrong names are told before a folder is made.
  const FitData data = fit_data(std::move(campaign), request);
  const bool to_files = !is_standard_output(options.out);
  if (to_files) {
    check_output_folder(options.out);
    warn_or_refuse_other_results(options.out, "fit.json", "diagnosis.json");
  }

  ProgressLine progress(options.common.quiet);
  const FitResult fit = [&] {
    try {
      return fit_campaign(data, request, remarks, command_line(),
                          [&](const std::string& stage, const std::string& of, const RunResult& run) {
                            progress.show(stage, static_cast<double>(run.evaluations) / static_cast<double>(run.budget),
                                          fmt::format("{} of {} evaluations, best NRMSE {}{}", run.evaluations,
                                                      run.budget, of.empty() ? "" : "of " + of + " ",
                                                      run.cost < diverged_cost ? format_number(run.cost, 4) : "-"));
                            return !interrupted();
                          });
    } catch (...) {
      progress.finish();
      warn_of(data.remarks);  // a motion that runs away may do so for what they say
      throw;
    }
  }();
  progress.finish();
  if (to_files) {
    make_output_folder(options.out);
    const std::filesystem::path out(options.out);
    write_file_atomically(out / "model.json", json_text(fit.model_file));
    write_file_atomically(out / "fit.json", json_text(fit.fit_file));
    write_file_atomically(out / "report.html", fit_report_html(fit.page));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    write_file_atomically(out / "environment.json", json_text(environment(options.common.threads, seconds)));
  } else {
    write_result(options.out, json_text(fit.model_file));
  }
  tell(fit, data, options);
  // The remarks have been made when the recordings were read.
  for (std::size_t k = remarks.size(); k < fit.warnings.size(); ++k) {
    const bool hint = fit.warnings[k] == fit.drive_hint.plain();
    fmt::print(stderr, "warning: {}\n", printable(hint ? fit.drive_hint.with(option_name) : fit.warnings[k]));
  }
  warn_of_failed_ends();
  if (!fit.diverged.empty()) {
    throw WorkError(fit.diverged);
  }
}

}  // namespace

void add_fit(CLI::App& program) {
  auto options = std::make_shared<FitOptions>();
  CLI::App* command = program.add_subcommand("fit", "identifies one parameter set over all recordings given");
  add_data_options(*command, options->data);
  add_keep_option(*command, options->data);
  command->add_option("--model", options->model, "damper law, see `hysteron list models`");
  command
      ->add_option("--effects", options->effects,
                   "effects put behind the law, joined by commas, see `hysteron list effects`")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--solver", options->solvers,
                   "solvers, joined by commas and compared when several; default multistart-lm")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_solver_option(*command, options->solver_commands);
  command->add_option("--budget", options->budget, "evaluations each solver may use")
      ->transform(whole_number(1, 1000000000))
      ->capture_default_str();
  add_law_options(*command, options->laws);
  command
      ->add_option("--stages", options->stages,
                   "two: also the laws through the values of conditions fitted freely, beside the joint fit")
      ->check(one_of({"one", "two"}))
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
  add_without_time_option(*command, options->data);
  CLI::Option* response = command->add_flag("--response", options->response,
                                            "the recordings are of a mass on the damper: its displacement, and the "
                                            "force on it or the displacement of its base (neither: free decay)");
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
      ->add_option("--excitation", options->excitation,
                   "force: on the mass; base: displacement of what it stands on; auto: what the files hold; with "
                   "--response")
      ->check(one_of({"auto", "force", "base"}))
      ->needs(response);
  command
      ->add_option("--interpolation", options->interpolation,
                   "of force or base between the samples: linear, cubic, band-limited; with --response")
      ->check(one_of({"linear", "cubic", "band-limited"}))
      ->needs(response);
  response->needs(command->get_option("--mass"));
  command
      ->add_option("--out", options->out,
                   "folder for model.json, fit.json, report.html; -: model.json on standard output")
      ->required();
  add_common_options(*command, options->common);
  command->footer(
      "Example:\n  hysteron fit recordings/ --model bouc-wen --by-current alpha:1,c0:1 --out out\n"
      "  hysteron fit recordings/ --model bouc-wen --by pressure=alpha:1,c0:1 --by temperature=c0:1 --out out\n"
      "  hysteron fit recordings/ --model modified-bouc-wen --effects offset-force --solver pso,ga,multistart-lm --out "
      "out\n"
      "  hysteron fit shaker/ --response --mass 250 --stiffness 2e4 --model bouc-wen --out out\n"
      "  hysteron fit crosshead/ --without-time --model bouc-wen --fix c0=0 --out out\n"
      "  hysteron fit recordings/ --model bouc-wen --solver mine --solver-command \"mine=python3 mine.py\" --out out");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app
