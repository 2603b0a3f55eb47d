// hysteron diagnose: names the physics a model leaves out, writes diagnosis.json, model.json, report.html.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/diagnosis_text.hpp"
#include "app/model_file.hpp"
#include "app/page.hpp"
#include "app/result.hpp"
#include "app/unfinished.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "diagnose/record.hpp"
#include "fit/usable.hpp"
#include "io/checkpoint.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "report/terminal.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

struct Options {
  DataOptions data;
  CommonOptions common;
  std::string model;
  std::string by_current;
  std::string by_frequency;
  std::vector<std::string> effects;
  std::vector<std::string> laws;
  int most_effects = 5;
  bool json = false;
  std::string out;
};

Identification identification_of(const Diagnosis& diagnosis, const Campaign& campaign,
                                 const ObjectiveOptions& objective, bool roles) {
  const Fit& fit = diagnosis.final;
  Identification result{*fit.layout, fit.terms, {}, {}, 0, fit.cost, fit.heldout, {}, {}, roles, {}};
  std::vector<Recording> fitted;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    const bool judged = roles && campaign.roles[k] == Role::validate;
    if (judged) {
      result.heldout.push_back(k);
    } else {
      result.fitted.push_back(k);
      fitted.push_back(campaign.recordings[k]);
    }
  }
  SolverOutcome outcome;
  outcome.run.solver = "multistart-lm";
  outcome.run.cost = fit.cost;
  result.solvers.push_back(outcome);
  estimate(result, Objective(*fit.layout, fitted, objective), fit.point, campaign.recordings.front().drive_kind);
  return result;
}

// What each name can be looked at by: the force in the stretch where its contrast acts, measured, of the base model and
// of the augmented one, over what the view says; by id.
json curves_json(const Diagnosis& diagnosis, const Campaign& campaign, const ObjectiveOptions& objective) {
  constexpr std::size_t most_points = 500;
  const auto predicted = [](const Fit& fit, const Target& target) {
    return predict(fit.layout->model(), fit.layout->held(), fit.terms, target);
  };
  json curves = json::object();
  const std::vector<Named> names = listed(diagnosis.verdict);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!diagnosis.views[k]) {
      continue;
    }
    const ContrastView& view = *diagnosis.views[k];
    const std::string& file = diagnosis.bench.split().fit[view.recording].file;
    const Recording& recording = *std::ranges::find(campaign.recordings, file, &Recording::file);
    const Target target = make_target(recording, objective);
    const std::vector<double> base = predicted(diagnosis.search.base, target);
    const std::vector<double> augmented =
        predicted(names[k].in_place_of ? fit_of(diagnosis, names[k]) : diagnosis.final, target);
    const auto first = std::ranges::lower_bound(recording.time, view.from) - recording.time.begin();
    const auto end = std::ranges::upper_bound(recording.time, view.to) - recording.time.begin();
    const std::ptrdiff_t stride = (end - first) / static_cast<std::ptrdiff_t>(most_points) + 1;
    json row = {{"recording", file},        {"over", word_of(view.over)},  {"x", json::array()},
                {"force_n", json::array()}, {"baseline_n", json::array()}, {"predicted_n", json::array()}};
    for (auto at = first; at < end; at += stride) {
      const auto n = static_cast<std::size_t>(at);
      row["x"].push_back(view.over == ForceOver::time           ? recording.time[n]
                         : view.over == ForceOver::displacement ? 1e3 * recording.displacement[n]
                                                                : 1e3 * recording.velocity[n]);
      row["force_n"].push_back(recording.force[n]);
      row["baseline_n"].push_back(base[n]);
      row["predicted_n"].push_back(augmented[n]);
    }
    curves[names[k].id] = std::move(row);
  }
  return curves;
}

void tell_found(const Checkpoint& checkpoint, bool quiet) {
  const std::string path = checkpoint.path().string();
  switch (checkpoint.found()) {
    case Checkpoint::Found::nothing:
    case Checkpoint::Found::in_use:  // trouble(), which is told with what else may go wrong
      return;
    case Checkpoint::Found::pieces:
      if (!quiet) {
        fmt::print(stderr, "resuming: {} finished pieces of work are in {}\n", checkpoint.pieces(), path);
      }
      return;
    case Checkpoint::Found::of_another_command:
      fmt::print(stderr, "{} is of other recordings, options or another program: starting afresh\n", path);
      return;
    case Checkpoint::Found::damaged:
      fmt::print(stderr, "{} is damaged: starting afresh\n", path);
      return;
  }
}

// Nothing where it was interrupted, which is said: what is known so far, and that rerunning the command resumes.
std::unique_ptr<Diagnosis> diagnosed(const Campaign& campaign, DiagnoseOptions options, Checkpoint* checkpoint,
                                     bool quiet) {
  ProgressLine progress(quiet);
  Unfinished unfinished;
  bool told = false;
  const auto tell_trouble = [&] {
    if (checkpoint == nullptr || told || checkpoint->trouble().empty()) {
      return;
    }
    progress.finish();
    fmt::print(stderr, "warning: {} cannot be kept: {}; an interruption would lose the work\n",
               checkpoint->path().string(), checkpoint->trouble());
    told = true;
  };
  options.checkpoint = checkpoint;
  options.stopped = interrupted;
  options.stands = [&](const Fit& fit) {
    if (!interrupted()) {  // then fits end before their end
      unfinished.stands(fit);
    }
  };
  std::unique_ptr<Diagnosis> result;
  try {
    result = diagnose(campaign, options, [&](double share, const std::string& stage) {
      if (interrupted()) {
        throw Stopped{};
      }
      progress.show(stage, share, "");
      unfinished.stage(share, stage);
      tell_trouble();
    });
  } catch (const Stopped&) {
    result.reset();
  } catch (const InputError&) {
    if (checkpoint != nullptr) {
      checkpoint->remove();
    }
    throw;
  }
  progress.finish();
  tell_trouble();
  if (!interrupted()) {
    return result;
  }
  const std::size_t pieces = checkpoint == nullptr || told ? 0 : checkpoint->pieces();
  if (pieces > 0) {
    unfinished.write(checkpoint->path().parent_path() / "interrupted.json", pieces);
  }
  fmt::print(stderr, "interrupted {}; {}\n", unfinished.sentence(),
             pieces > 0 ? fmt::format("{} finished pieces of work are in {}; rerun the command to resume", pieces,
                                      checkpoint->path().string())
                        : "nothing was written");
  return nullptr;
}

void run(const Options& options) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<std::string> remarks;
  const Campaign campaign = load(options.data, Required::motion_and_force, &remarks);
  require_usable(campaign.recordings);
  DiagnoseOptions diagnose_with;
  diagnose_with.model = !options.model.empty() ? options.model : (campaign.model.empty() ? "bouc-wen" : campaign.model);
  diagnose_with.layout.by_current =
      options.by_current.empty() ? campaign.by_current : parse_orders("--by-current", options.by_current);
  diagnose_with.layout.by_frequency =
      options.by_frequency.empty() ? campaign.by_frequency : parse_orders("--by-frequency", options.by_frequency);
  diagnose_with.objective = objective_options(options.common);
  diagnose_with.seed = options.common.seed;
  diagnose_with.most_effects = options.most_effects;
  diagnose_with.candidates = options.effects;
  refuse_repeats("--laws", options.laws);
  if (options.laws == std::vector<std::string>{"none"}) {
    diagnose_with.laws.clear();
  } else if (!options.laws.empty()) {
    diagnose_with.laws = options.laws;
    for (const std::string& law : options.laws) {
      make_model(law, {});
    }
  }
  // Wrong names are told before any work.
  make_model(diagnose_with.model, {});
  refuse_repeats("--effects", options.effects);
  for (const std::string& effect : options.effects) {
    make_model(diagnose_with.model, {effect});
  }
  for (const Recording& recording : campaign.recordings) {
    normaliser(recording, diagnose_with.objective.normalisation);
  }
  const bool to_files = !is_standard_output(options.out);
  const std::filesystem::path out(options.out);
  std::optional<Checkpoint> checkpoint;
  if (to_files) {
    check_output_folder(out);
    checkpoint.emplace(out / "diagnosis.partial", identity_of(campaign, diagnose_with));
    tell_found(*checkpoint, options.common.quiet);
  }
  const std::unique_ptr<Diagnosis> diagnosis =
      diagnosed(campaign, diagnose_with, checkpoint ? &*checkpoint : nullptr, options.common.quiet);
  if (diagnosis == nullptr) {
    return;
  }
  if (to_files) {
    make_output_folder(out);
  }

  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; });
  const Identification result = identification_of(*diagnosis, campaign, diagnose_with.objective, roles);
  IdentifyOptions stored;
  stored.seed = diagnose_with.seed;
  stored.objective = diagnose_with.objective;
  stored.layout = diagnose_with.layout;
  for (const ParameterLaw& law : result.layout.laws()) {
    if (law.drive_nodes.size() > 1) {
      stored.layout.by_current[result.layout.names()[law.parameter]] = static_cast<int>(law.drive_nodes.size()) - 1;
    }
  }
  const json model_file = model_json(result, campaign, stored);
  json diagnosis_file = diagnosis_json(*diagnosis);
  diagnosis_file["warnings"] = remarks;

  json rows = json::array();
  json page_recordings = json::array();
  json data = json::array();
  for (const Recording& recording : campaign.recordings) {
    const Target target = make_target(recording, diagnose_with.objective);
    Prediction prediction;
    prediction.force = predict(result.layout.model(), result.layout.held(), result.terms, target);
    prediction.score = score(prediction.force, recording, diagnose_with.objective.normalisation);
    const Fit& base = diagnosis->search.base;
    const bool judged = std::ranges::any_of(diagnosis->bench.split().judge, [&](const Judged& one) {
      return one.recording.file == recording.file && one.from == 0;
    });
    page_recordings.push_back(recording_json(recording, prediction, judged ? "held out in the check" : "fit",
                                             campaign.recordings.size(),
                                             predict(base.layout->model(), base.layout->held(), base.terms, target)));
    data.push_back({{"file", recording.file}, {"sha256", recording.sha256}});
  }
  json page = {{"title", "Diagnosis of " + std::string(diagnosis->search.base.layout->model().law->title)},
               {"subtitle", fmt::format("{} recordings", campaign.recordings.size())},
               {"version", HYSTERON_VERSION},
               {"command", command_line()},
               {"seed", options.common.seed},
               {"normalisation", word_of(diagnose_with.objective.normalisation)},
               {"weighting", options.common.weighting},
               {"recordings", page_recordings},
               {"data", data},
               {"diagnosis", diagnosis_file},
               {"curves", curves_json(*diagnosis, campaign, diagnose_with.objective)},
               {"notes", diagnosis->notes},
               {"warnings", remarks},
               {"solvers", json::array()},
               {"provenance", model_file["provenance"]}};
  std::vector<std::string> equations(result.layout.model().law->equations.begin(),
                                     result.layout.model().law->equations.end());
  for (const Part* effect : result.layout.model().effects) {
    equations.insert(equations.end(), effect->equations.begin(), effect->equations.end());
  }
  page["model"] = {{"id", result.layout.model().law->id},
                   {"title", result.layout.model().law->title},
                   {"equations", equations},
                   {"reference", result.layout.model().law->reference}};
  page["parameters"] = json::array();
  for (const Estimate& row : result.estimates) {
    page["parameters"].push_back(estimate_json(row, result.layout));
  }
  const Search& search = diagnosis->search;
  page["summary"] = json::array({{{"label", "Held-out NRMSE, base model"},
                                  {"value", format_number(search.base.heldout, 3)},
                                  {"note", search.base.what.model}},
                                 {{"label", "Held-out NRMSE, augmented"},
                                  {"value", format_number(search.augmented.heldout, 3)},
                                  {"note", diagnosis->bench.split().how}},
                                 {{"label", "Noise floor, held out"},
                                  {"value", format_number(diagnosis->noise_floor_heldout, 3)},
                                  {"note", "fitted " + format_number(diagnosis->noise_floor, 3) + ", by " +
                                               std::string(word_of(diagnosis->noise_floor_method))}}});

  if (!to_files) {
    write_result(options.out, json_text(diagnosis_file));
    say_beside(options.out, diagnosis_text(diagnosis_file, "diagnosis.json"));
    return;
  }
  // diagnosis.json last: it says that all are there.
  write_file_atomically(out / "model.json", json_text(model_file));
  write_file_atomically(out / "report.html", fit_report_html(page));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  write_file_atomically(out / "environment.json", json_text(environment(options.common.threads, seconds)));
  write_file_atomically(out / "diagnosis.json", json_text(diagnosis_file));
  std::error_code ignored;
  std::filesystem::remove(out / "interrupted.json", ignored);
  checkpoint->remove();
  if (options.json) {
    fmt::print("{}", json_text(diagnosis_file));
  } else {
    fmt::print("{}report: {}\n", diagnosis_text(diagnosis_file, (out / "diagnosis.json").string()),
               (out / "report.html").string());
  }
}

}  // namespace

void add_diagnose(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("diagnose", "finds where recording and simulation differ and names the missing physics");
  add_data_options(*command, options->data);
  add_keep_option(*command, options->data);
  command->add_option("--model", options->model, "base damper law; default campaign.toml's, else bouc-wen");
  command->add_option("--by-current", options->by_current,
                      "parameters that are polynomials in the drive, e.g. alpha:1,c0:1");
  command->add_option("--by-frequency", options->by_frequency, "parameters that are polynomials in frequency");
  command->add_option("--effects", options->effects, "effects to consider; default all, see `hysteron list effects`")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--laws", options->laws,
                   "damper laws that the base law is set against; `none`: it is taken for right")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--most-effects", options->most_effects, "effects the augmented model may have")
      ->transform(whole_number(1, 7))
      ->capture_default_str();
  command->add_flag("--json", options->json, "diagnosis.json on standard output too");
  command
      ->add_option("--out", options->out,
                   "folder for diagnosis.json, model.json, report.html; -: diagnosis.json on standard output")
      ->required();
  add_common_options(*command, options->common);
  command->footer("Example:\n  hysteron diagnose recordings/ --model bouc-wen --by-current alpha:1,c0:1 --out out");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app
