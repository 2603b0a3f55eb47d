#include "task/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "diagnose/options.hpp"
#include "fit/predict.hpp"
#include "fit/usable.hpp"
#include "fit/weighting.hpp"
#include "report/terminal.hpp"
#include "task/excitation_faults.hpp"
#include "task/finite.hpp"
#include "task/fit_quality.hpp"
#include "task/guesses.hpp"
#include "task/laws.hpp"
#include "task/model_file.hpp"
#include "task/page.hpp"
#include "task/rate.hpp"
#include "task/remarks.hpp"
#include "task/residual_record.hpp"
#include "task/response_faults.hpp"
#include "task/stages.hpp"
#include "task/track.hpp"
#include "task/words.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

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
          {"stopped", outcome.run.stopped()},
          {"chosen", k == result.chosen},
          {"trace", trace_json(outcome.run)},
          {"starts", starts_json(outcome.run)},
          {"track", track_json(outcome.run, result.layout, followed)}};
}

json final_json(const Identification& result) {
  if (!result.final_run) {
    return nullptr;
  }
  const RunResult& run = *result.final_run;
  return {{"stage", result.final_stage},    {"solver", run.solver}, {"cost", run.cost},
          {"evaluations", run.evaluations}, {"budget", run.budget}, {"stopped", run.stopped()},
          {"starts", starts_json(run)}};
}

json rig_json(const Rig& rig) {
  return {{"mass_kg", rig.mass},
          {"stiffness_n_per_m", rig.stiffness},
          {"damping_n_s_per_m", rig.damping},
          {"excitation", rig.base ? "base" : "force"},
          {"interpolation", word_of(rig.interpolation)}};
}

// What tells a model that was identified from the motion of a mass, in model.json: the force of these recordings is not
// the damper's.
json from_response_json(const Rig& rig, const std::vector<Recording>& responses) {
  json result = rig_json(rig);
  result["recordings"] = json::array();
  for (const Recording& recording : responses) {
    result["recordings"].push_back({{"file", recording.file}, {"sha256", recording.sha256}});
  }
  return result;
}

json response_json(const ResponseFit& fit, const Rig& rig) {
  const auto finite = [](double value) { return std::isfinite(value) && value < diverged_cost ? json(value) : json(); };
  json rows = json::array();
  for (const ResponseScore& score : fit.scores) {
    rows.push_back({{"file", score.file}, {"nrmse", finite(score.nrmse)}, {"rmse_m", finite(score.rmse)}});
  }
  json result = rig_json(rig);
  result.update({{"nrmse_of_equation_of_motion", finite(fit.before)},
                 {"nrmse", finite(fit.cost)},
                 {"evaluations", fit.run.evaluations},
                 {"stopped", fit.run.stopped()},
                 {"recordings", rows}});
  return result;
}

// Words of the records.
struct Names {
  std::string heldout;  // of the recordings held out, for a sentence
  std::string normalisation;
};

Names names_of(const Identification& result, const Campaign& campaign, const IdentifyOptions& options) {
  constexpr std::size_t most_named = 20;
  Names names{{}, std::string(word_of(options.objective.normalisation))};
  for (std::size_t k = 0; k < std::min(most_named, result.heldout.size()); ++k) {
    names.heldout += (k > 0 ? ", " : "") + campaign.recordings[result.heldout[k]].file;
  }
  if (result.heldout.size() > most_named) {
    names.heldout += fmt::format(" and {} more", result.heldout.size() - most_named);
  }
  return names;
}

json summary_json(const FitResult& fit, const Names& names) {
  const Identification& result = fit.identification;
  json summary = json::array();
  if (fit.response) {
    summary.push_back({{"label", "NRMSE, displacement of the mass"},
                       {"value", format_number(fit.response->cost, 3)},
                       {"note", "of the fitted recordings, over the largest displacement of each"}});
  }
  summary.push_back(
      {{"label", fit.response ? "NRMSE, force of the equation of motion" : "NRMSE, fitted recordings"},
       {"value", format_number(result.cost, 3)},
       {"note", fit.response ? "of the damper's force by m x'', with all noise of the acceleration; not plotted"
                             : "root mean square over recordings, normalised by " + names.normalisation}});
  if (result.nrmse_heldout) {
    summary.push_back(
        {{"label", fit.response ? "NRMSE, held-out force of the equation of motion" : "NRMSE, held-out recordings"},
         {"value", format_number(*result.nrmse_heldout, 3)},
         {"note", "fitted without " + names.heldout}});
  }
  const RunResult& chosen = result.solvers[result.chosen].run;
  summary.push_back(
      {{"label", "Evaluations"},
       {"value", std::to_string(chosen.evaluations + (fit.response ? fit.response->run.evaluations : 0))},
       {"note", chosen.solver + ": " + chosen.stopped() +
                    (fit.response ? fmt::format("; of these {} of the motion by lm: {}", fit.response->run.evaluations,
                                                fit.response->run.stopped())
                                  : "") +
                    (result.final_run ? fmt::format("; and {} in the {} by {}", result.final_run->evaluations,
                                                    result.final_stage, result.final_run->solver)
                                      : "")}});
  return summary;
}

double deviation_of(const std::vector<double>& values) {
  double sum = 0.0;
  double square = 0.0;
  for (const double value : values) {
    sum += value - values.front();
    square += (value - values.front()) * (value - values.front());
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(std::max(square / count - sum * sum / (count * count), 0.0));
}

// Recorded less simulated displacement over the largest recorded one; empty where the motion runs away.
std::vector<double> motion_residual(const Recording& recording, const std::vector<double>& simulated) {
  double largest = 0.0;
  for (const double x : recording.displacement) largest = std::max(largest, std::fabs(x));
  std::vector<double> result;
  for (std::size_t n = 0; n < simulated.size(); ++n) {
    result.push_back((recording.displacement[n] - simulated[n]) / largest);
  }
  return result;
}

// The errors of a recording's row are of the motion.
void show_motion(json& row, const ResponseScore& score, const std::vector<double>& displacement) {
  const auto finite_or_null = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  const double spread = deviation_of(displacement);
  row["nrmse"] = finite_or_null(score.nrmse);
  row["rmse_mm"] = finite_or_null(1e3 * score.rmse);
  row["fit_percent"] = finite_or_null(spread > 0.0 ? 100.0 * (1.0 - score.rmse / spread) : std::nan(""));
}

json page_json(const FitResult& fit, const FitData& data, const FitRequest& request, const std::string& command,
               const Names& names, json recordings) {
  const Identification& result = fit.identification;
  const CompositeModel& model = result.layout.model();
  json page = fit.fit_file;
  page["title"] = "Identification of " + std::string(model.law->title);
  page["subtitle"] =
      fmt::format("{} recordings, {} free parameters", data.campaign.recordings.size(), result.layout.dimension());
  page["version"] = HYSTERON_VERSION;
  page["command"] = command;
  page["seed"] = request.identify.seed;
  page["model"] = model_card_json(model);
  page["summary"] = summary_json(fit, names);
  page["recordings"] = std::move(recordings);
  page["data"] = data_json(data.campaign);
  page["notes"] = {
      "Standard errors come from the curvature at the optimum with the effective sample size of the "
      "correlated residual; they do not cover what the model leaves out.",
      fit.response ? "Fit [%] = 100 (1 - RMSE / standard deviation of the measured displacement)."
                   : "Fit [%] = 100 (1 - RMSE / standard deviation of the measured force).",
      "A derivative evaluation is charged as 1 + number of free parameters evaluations."};
  if (std::ranges::any_of(result.solvers, [](const SolverOutcome& outcome) { return !outcome.run.track.empty(); })) {
    page["notes"].push_back(
        "Bands of parameters against time are the filter's own: they hold as far as the model and its noise level do.");
  }
  page["diagnosis"] = nullptr;
  return page;
}

json fit_json(const FitResult& fit, const FitData& data, const FitRequest& request, const Names& names) {
  const Identification& result = fit.identification;
  const Campaign& campaign = data.campaign;
  json heldout_files = json::array();
  for (const std::size_t k : result.heldout) {
    heldout_files.push_back(campaign.recordings[k].file);
  }
  json rows = json::array();
  for (std::size_t k = 0; k < fit.scores.size(); ++k) {
    rows.push_back({{"file", campaign.recordings[k].file},
                    {"role", fit.held_out[k] && result.roles_given ? "validate" : "fit"},
                    {"held_out_in_check", static_cast<bool>(fit.held_out[k])},
                    {"nrmse", fit.scores[k].nrmse},
                    {"rmse_n", fit.scores[k].rmse},
                    {"fit_percent", fit.scores[k].fit_percent}});
  }
  json solvers = json::array();
  for (std::size_t k = 0; k < result.solvers.size(); ++k) {
    solvers.push_back(solver_json(result, campaign, k));
  }
  json estimates = json::array();
  for (const Estimate& estimate : result.estimates) {
    estimates.push_back(estimate_json(estimate, result.layout));
  }
  return {{"schema", "hysteron.fit/1"},
          {"model", fit.model_file["model"]},
          {"effects", fit.model_file["effects"]},
          {"normalisation", names.normalisation},
          {"weighting", word_of(request.identify.objective.weighting)},
          {"nrmse", fit.model_file["nrmse"]},
          {"held_out", heldout_files},
          {"held_out_by", result.roles_given ? "campaign.toml" : "the program; final fit uses all recordings"},
          {"solvers", solvers},
          {"final", final_json(result)},
          {"parameters", estimates},
          {"correlation", correlation_json(result, campaign.recordings.front().drive_kind)},
          {"sensitivity", sensitivity_json(result)},
          {"residual", fit.residual ? residual_json(*fit.residual, result.layout.dimension()) : json(nullptr)},
          {"recordings", rows},
          {"stages", fit.two_stages ? stages_json(*fit.two_stages, result, campaign) : json(nullptr)},
          {"response", fit.response ? response_json(*fit.response, *request.rig) : json(nullptr)},
          {"warnings", fit.warnings},
          {"on_bounds", result.bounds_met.plain()},
          {"provenance", fit.model_file["provenance"]}};
}

}  // namespace

namespace {

// Whether the mass stands on a base that moves; its recordings then have no force on it.
bool on_base(Excites excitation, std::vector<Recording>& responses) {
  const auto has = [&](const auto& channel) {
    return std::ranges::any_of(responses, [&](const Recording& recording) { return !channel(recording).empty(); });
  };
  const bool base = has([](const Recording& r) -> const std::vector<double>& { return r.base; });
  const bool force = has([](const Recording& r) -> const std::vector<double>& { return r.force; });
  const bool recorded = excitation == Excites::what_is_recorded;
  if (recorded && base && force) {
    throw OptionError(responses.front().file + ": a force and a base, expected " + Option::excitation +
                      " force or base");
  }
  const bool result = recorded ? base : excitation == Excites::base;
  for (Recording& recording : responses) {
    if (result) recording.force.clear();
    if (excitation == Excites::force && recording.force.empty()) {
      throw OptionError(recording.file + ": no force column, expected one for " + Option::excitation + " force");
    }
  }
  return result;
}

// A response under nothing is a free decay, which a column that nothing knows may contradict.
std::vector<std::string> free_decays(const std::vector<Recording>& responses) {
  std::vector<std::string> remarks;
  for (const Recording& recording : responses) {
    if (!recording.force.empty() || !recording.base.empty() || recording.unused.empty()) continue;
    std::string columns;
    for (const UnusedColumn& column : recording.unused) columns += (columns.empty() ? "'" : "', '") + column.name;
    remarks.push_back(fmt::format("{}: no force on the mass and no base: taken as a free decay, without {}'",
                                  recording.file, columns));
  }
  return remarks;
}

// What is wrong with the model on these recordings.
void check_before(const Layout& layout, const FitData& data, const FitRequest& request) {
  if (request.rig) {
    refuse_if_not_responding(layout, data.responses, *request.rig);
  }
  std::vector<bool> may_act;
  for (const double held : layout.held()) may_act.push_back(held != 0.0);
  bool follows_frequency = false;
  for (const ParameterLaw& law : layout.laws()) {
    may_act[law.parameter] = true;
    follows_frequency = follows_frequency || law.frequency_nodes.size() > 1;
  }
  require_no_rate(layout.model(), may_act, follows_frequency, data.campaign.recordings,
                  Option::fix + " PARAMETER=0, a law without it, or recordings with time");
}

// Whether laws were asked to follow the drive, or equations take it themselves. What was found does not count: where
// all values of a law lie on one end of their box it was asked for all the same.
bool follows_drive(const Layout& layout, const Recording& recording, const ObjectiveOptions& objective) {
  const auto in_drive = [](const ParameterLaw& law) { return law.drive_nodes.size() > 1; };
  if (std::ranges::any_of(layout.laws(), in_drive)) return true;
  const std::vector<Term> middle = layout.terms(std::vector<double>(layout.dimension(), 0.5));
  const auto force = [&](const Recording& on) {
    return predict(layout.model(), layout.held(), middle, make_target(on, objective));
  };
  Recording without = recording;
  without.drive.clear();
  without.drive_kind = DriveKind::none;
  // Numbers that are none, of a model that runs away in the middle of its box, are no difference.
  return !std::ranges::equal(force(recording), force(without),
                             [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

// "alpha:1,c0:1": the laws that `diagnose` assumes.
std::string likely_laws(const std::string& model, const std::vector<Recording>& recordings) {
  std::string result;
  for (const auto& [name, order] : base_laws(model, recordings)) {
    result += (result.empty() ? "" : ",") + fmt::format("{}:{}", name, order);
  }
  return result.empty() ? "PARAMETER:1" : result;
}

// Recordings at several values of the drive, of which nothing in the model knows; empty where it does.
Message drive_hint(const Identification& result, const std::vector<Recording>& recordings,
                   const ObjectiveOptions& objective) {
  const DriveKind kind = recordings.front().drive_kind;
  const bool of_one_kind = std::ranges::all_of(recordings, [&](const Recording& r) { return r.drive_kind == kind; });
  const auto largest = [](const Recording& recording) { return peak_of(recording.drive); };
  const std::size_t levels = drive_levels(recordings);
  if (kind == DriveKind::none || !of_one_kind || levels < 2 ||
      follows_drive(result.layout, *std::ranges::max_element(recordings, {}, largest), objective)) {
    return "";
  }
  const std::string drive = kind == DriveKind::voltage ? "voltage" : "current";
  return (std::ranges::any_of(recordings, drive_varies)
              ? "the " + drive + " of the recordings varies"
              : fmt::format("the recordings hold {} levels of the {}", levels, drive)) +
         " and no parameter follows it: " + Option::by_current + " " +
         likely_laws(std::string(result.layout.model().law->id), recordings);
}

// What is held has no bounds to move in.
void refuse_held_with_bounds(const LayoutOptions& layout) {
  for (const auto& [name, value] : layout.fix) {
    if (!layout.bounds.contains(name)) continue;
    throw OptionError(Option::fix + " " + name + ": a parameter that is held has no bounds, expected it in " +
                      Option::fix + " or in " + Option::bounds + " alone");
  }
}

// What gives laws in the frequency: the option, or a line of campaign.toml.
Message giver_of_frequency_laws(const LayoutOptions& asked, const Campaign& campaign) {
  if (!asked.by_frequency.empty()) return Option::by_frequency;
  for (const auto& [law, line] : campaign.lines_of_laws) {
    if (law.first == "frequency") return fmt::format("the law in it of {}:{}", line.file, line.line);
  }
  return "the laws in it of campaign.toml";
}

// A law in the frequency would take it for a motion at rest. `given` is what gives the laws.
void refuse_unknown_frequency(const LayoutOptions& layout, const Message& given,
                              const std::vector<Recording>& recordings) {
  if (layout.by_frequency.empty()) return;
  for (const Recording& recording : recordings) {
    if (!turns_once(recording)) continue;
    throw OptionError(recording.file + ": the motion turns once, so that its frequency is not known, expected two " +
                      "turning points or more with " + given);
  }
}

}  // namespace

FitData fit_data(Campaign campaign, FitRequest& request) {
  require_usable(campaign.recordings, request.rig ? ForceOf::excitation : ForceOf::damper);
  FitData data{std::move(campaign), {}, {}, {}};
  if (request.rig) {
    data.responses = std::move(data.campaign.recordings);
    request.rig->base = on_base(request.excitation, data.responses);
    data.remarks = free_decays(data.responses);
    std::vector<Remark> faults;
    for (const Recording& recording : data.responses) {
      for (Remark& remark : faults_of_excitation(recording, request.rig->base)) faults.push_back(std::move(remark));
    }
    for (Remark& remark : mend_responses(data.responses, *request.rig)) faults.push_back(std::move(remark));
    append(data.remarks, told_once(faults));
    data.campaign.recordings = damper_recordings(data.responses, *request.rig);
  }
  data.model = request.model.empty() ? data.campaign.model : request.model;
  if (data.model.empty()) {
    throw OptionError("no model: expected " + Option::model +
                      " NAME or a model in campaign.toml, see `hysteron list models`");
  }
  IdentifyOptions& identify_with = request.identify;
  refuse_repeats(Option::solver, identify_with.solvers);
  refuse_repeats(Option::effects, identify_with.effects);
  LayoutOptions& layout = identify_with.layout;
  refuse_held_with_bounds(layout);
  const CompositeModel model = make_model(data.model, identify_with.effects);
  refuse_laws_of_other_model(data.campaign, layout, model);
  refuse_laws_of_one_level(data.campaign, layout, scale_of_fitted(data.campaign));
  const Message giver = giver_of_frequency_laws(layout, data.campaign);
  add_laws_of(data.campaign, layout);
  refuse_unknown_frequency(layout, giver, data.campaign.recordings);
  if (!layout.by_current.empty()) {
    require_one_drive(request.rig ? data.responses : data.campaign.recordings);
  }
  if (request.rig) append(data.remarks, told_once(places_of_rest(data.responses, *request.rig, model)));
  normaliser(data.campaign.recordings.front(), identify_with.objective.normalisation);
  if (request.two_stages && layout.by_current.empty() && layout.by_frequency.empty()) {
    throw OptionError(Option::stages + " two: no parameter has a law, expected " + Option::by_current + " or " +
                      Option::by_frequency);
  }
  if (request.two_stages && request.rig) {
    throw OptionError(Option::stages + " two: values of conditions are not fitted to a response, expected one stage");
  }
  check_before(Layout(model, scale_of(data.campaign.recordings), layout), data, request);
  return data;
}

FitResult fit_campaign(const FitData& data, const FitRequest& request, const std::vector<std::string>& remarks,
                       const std::string& command, const FitProgress& progress) {
  const Campaign& campaign = data.campaign;
  const IdentifyOptions& identify_with = request.identify;
  const ObjectiveOptions& objective = identify_with.objective;
  const auto interrupted = [&] { return objective.stopped && objective.stopped(); };
  const Progress show = [&](const std::string& stage, const RunResult& run) { return progress(stage, {}, run); };
  FitResult fit{identify(campaign, data.model, identify_with, show)};
  Identification& result = fit.identification;
  if (request.rig && !interrupted()) {
    fit.response = refine(result, data.responses, *request.rig, identify_with, [&](const RunResult& run) {
      return progress("lm: motion of the mass", "the displacement", run);
    });
    result.cost = predicted_nrmse(result.layout, result.terms, refer_to(campaign.recordings, result.fitted), objective);
    if (result.roles_given && !result.heldout.empty()) {
      result.nrmse_heldout = predicted_nrmse(result.layout, result.terms, refer_to(campaign.recordings, result.heldout),
                                             objective, refer_to(campaign.recordings, result.fitted));
    }
  }
  // An error that is not finite is none; the recordings it comes from are named below.
  const auto drop_if_not_finite = [](std::optional<double>& error) {
    if (error && !std::isfinite(*error)) error.reset();
  };
  drop_if_not_finite(result.nrmse_heldout);
  for (SolverOutcome& outcome : result.solvers) drop_if_not_finite(outcome.nrmse_heldout);
  if (request.two_stages && !interrupted()) {
    try {
      fit.two_stages =
          fit_two_stage(campaign, result.layout, result.compared_on(campaign.recordings.size()), result.heldout,
                        *find_solver(result.solvers[result.chosen].run.solver), identify_with, show);
    } catch (const Stopped&) {
      fit.two_stages.reset();
    }
  }

  fit.held_out.assign(campaign.recordings.size(), false);
  for (const std::size_t k : result.heldout) fit.held_out[k] = true;
  // One prediction at a time: it is as long as its recording.
  json page_recordings = json::array();
  std::vector<std::vector<double>> residuals;  // of the fitted recordings
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const Recording& recording = campaign.recordings[k];
    const Target target = make_target(recording, objective);
    Prediction prediction;
    prediction.force = predict(result.layout.model(), result.layout.held(), result.terms, target);
    prediction.score = score(prediction.force, recording, objective.normalisation);
    if (const auto time = diverges_at(prediction.force, recording)) {
      fit.diverged += fmt::format("{}{} from {:g} s on", fit.diverged.empty() ? "" : ", ", recording.file, *time);
    }
    const std::string shown_role = !fit.held_out[k] ? "fit" : result.roles_given ? "validate" : "checked";
    if (fit.response) {
      prediction.motion = fit.response->motions[k].displacement;
    }
    if (std::ranges::find(result.fitted, k) != result.fitted.end()) {
      residuals.push_back(fit.response ? motion_residual(recording, prediction.motion)
                                       : normalised_residual(recording, prediction.force, objective.normalisation));
    }
    page_recordings.push_back(recording_json(recording, prediction, shown_role, campaign.recordings.size()));
    if (fit.response) {
      show_motion(page_recordings.back(), fit.response->scores[k], recording.displacement);
    }
    fit.scores.push_back(prediction.score);
  }

  // Of a simulation that runs away nothing is left over that could be looked at.
  if (std::ranges::all_of(residuals, [](const std::vector<double>& series) {
        return !series.empty() && std::ranges::all_of(series, [](double value) { return std::isfinite(value); });
      })) {
    fit.residual = residual_facts(residuals);
  }

  fit.warnings = remarks;
  append(fit.warnings, data.remarks);
  fit.warnings.insert(fit.warnings.end(), result.warnings.begin(), result.warnings.end());
  fit.drive_hint = drive_hint(result, campaign.recordings, objective);
  if (!fit.drive_hint.empty()) fit.warnings.push_back(fit.drive_hint.plain());
  fit.interrupted = interrupted();
  if (fit.interrupted) {
    fit.warnings.emplace_back("interrupted: the solvers did not use their whole budget");
  }
  if (!fit.diverged.empty()) {
    fit.diverged = "the simulation of the fitted model does not stay finite: " + fit.diverged;
    fit.warnings.push_back(fit.diverged);
  }
  const Names names = names_of(result, campaign, identify_with);
  fit.model_file = model_json(result, campaign, identify_with, command);
  if (result.roles_given && !result.heldout.empty()) {
    append(fit.warnings, held_out_beyond_fitted(fit.model_file, campaign.recordings, result.heldout));
  }
  if (request.rig) fit.model_file["response"] = from_response_json(*request.rig, data.responses);
  fit.fit_file = fit_json(fit, data, request, names);
  fit.page = page_json(fit, data, request, command, names, std::move(page_recordings));
  return fit;
}

}  // namespace hysteron
