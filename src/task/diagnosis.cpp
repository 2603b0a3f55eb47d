#include "task/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "diagnose/record.hpp"
#include "fit/estimate_blocks.hpp"
#include "fit/usable.hpp"
#include "fit/weighting.hpp"
#include "report/terminal.hpp"
#include "task/fit_quality.hpp"
#include "task/laws.hpp"
#include "task/model_file.hpp"
#include "task/page.hpp"
#include "task/words.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

// Counts the blocks of samples that an objective passes, on whatever threads, and tells how many of a hundred parts are
// done from the thread that it belongs to. A thread is known by an object of its own, as a browser's standard library
// has no <thread>.
class Blocks {
 public:
  explicit Blocks(const std::function<void(double share)>& done) : done_(done) {}
  void expect(std::size_t whole) { whole_ = std::max<std::size_t>(whole, 1); }
  void add() {
    const std::size_t count = ++count_;
    if (&here() != own_) return;
    const std::size_t parts = std::min<std::size_t>(100 * count / whole_, 100);
    if (parts > told_) {
      told_ = parts;
      done_(static_cast<double>(parts) / 100.0);
    }
  }

 private:
  static const char& here() {
    thread_local const char mark = 0;
    return mark;
  }

  const std::function<void(double share)>& done_;
  std::size_t whole_ = 1;
  std::atomic<std::size_t> count_{0};
  const char* own_ = &here();
  std::size_t told_ = 0;  // to `own_`
};

// `done` is told the share of it that is done.
Identification identification_of(const Diagnosis& diagnosis, const Campaign& campaign,
                                 const ObjectiveOptions& objective, bool roles,
                                 const std::function<void(double share)>& done) {
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
  Blocks blocks(done);
  ObjectiveOptions told = objective;
  if (done) {
    told.stopped = [&] {
      blocks.add();
      return objective.stopped && objective.stopped();
    };
  }
  // On every sample, as `score` has them: the search counts thinned recordings without their run-in.
  const auto error_on = [&](const std::vector<std::size_t>& which) {
    return predicted_nrmse(*fit.layout, fit.terms, refer_to(campaign.recordings, which), objective,
                           refer_to(campaign.recordings, result.fitted));
  };
  if (const double error = error_on(result.fitted); std::isfinite(error)) result.cost = error;
  if (!result.heldout.empty()) {
    if (const double error = error_on(result.heldout); std::isfinite(error)) result.nrmse_heldout = error;
  }
  const Objective on_all(*fit.layout, fitted, told);
  blocks.expect(blocks_of_estimate(on_all));
  estimate(result, on_all, fit.point, campaign.recordings.front().drive_kind);
  return result;
}

// What each name can be looked at by: the force in the stretch where its contrast acts, measured, of the base model, of
// the augmented one and, where that holds other effects, of what is refitted without this one, over what the view says;
// by id.
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
    const Fit& others = without_of(diagnosis, names[k]);
    const std::vector<double> without =
        others.what == diagnosis.search.base.what ? std::vector<double>{} : predicted(others, target);
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
      if (!without.empty()) {
        row["without_n"].push_back(without[n]);
      }
    }
    curves[names[k].id] = std::move(row);
  }
  return curves;
}

// Parameters that the laws and effects which are tried have, beside those of the base law.
std::set<std::string> parameters_elsewhere(const DiagnoseOptions& options) {
  std::set<std::string> result;
  const auto add = [&](const CompositeModel& model) {
    for (const std::string& name : model.parameter_names()) result.insert(name);
  };
  for (const std::string& law : options.laws) add(make_model(law, {}));
  for (const Part* effect : effect_catalogue()) add(make_model(options.model, {std::string(effect->id)}));
  for (const std::string& name : make_model(options.model, {}).parameter_names()) result.erase(name);
  return result;
}

// Laws of parameters that no model has would be left out without a word.
void check_laws(const Campaign& campaign, DiagnoseOptions& options) {
  const CompositeModel base = make_model(options.model, {});
  const std::set<std::string> elsewhere = parameters_elsewhere(options);
  const DataScale scale = scale_of_fitted(without_apart(campaign));
  refuse_laws_of_other_model(campaign, options.layout, base, elsewhere);
  refuse_laws_of_one_level(campaign, options.layout, scale);
  add_laws_of(campaign, options.layout);
  LayoutOptions of_base = options.layout;
  const auto leave_out = [&](LawOrders& orders) {
    std::erase_if(orders, [&](const auto& law) { return elsewhere.contains(law.first); });
  };
  leave_out(of_base.by_current);
  leave_out(of_base.by_frequency);
  for (auto& [condition, orders] : of_base.by) leave_out(orders);
  static_cast<void>(Layout(base, scale, of_base));
}

}  // namespace

void check_diagnosis(const Campaign& campaign, DiagnoseOptions& options) {
  require_usable(campaign.recordings);
  require_one_drive(campaign.recordings);  // effects of the drive are looked for in every campaign
  if (options.model.empty()) options.model = campaign.model.empty() ? "bouc-wen" : campaign.model;
  refuse_repeats(Option::laws, options.laws);
  for (const std::string& law : options.laws) {
    make_model(law, {});
  }
  make_model(options.model, {});
  refuse_repeats(Option::effects, options.candidates);
  for (const std::string& effect : options.candidates) {
    make_model(options.model, {effect});
  }
  check_laws(campaign, options);
  for (const Recording& recording : campaign.recordings) {
    normaliser(recording, options.objective.normalisation);
  }
}

DiagnosisRecords records_of(const Diagnosis& diagnosis, const Campaign& recorded, const DiagnoseOptions& options,
                            const std::vector<std::string>& remarks, const std::string& command,
                            const std::function<void(double share)>& done) {
  // Shares of the time that the standard errors and the forces on all recordings take.
  constexpr double of_errors = 0.87;
  constexpr double of_forces = 0.98;
  if (done) done(0.0);
  const Campaign campaign = without_apart(recorded);
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role == Role::validate; });
  std::function<void(double share)> of_estimates;
  if (done) of_estimates = [&](double share) { done(of_errors * share); };
  const Identification result = identification_of(diagnosis, campaign, options.objective, roles, of_estimates);
  IdentifyOptions stored;
  stored.seed = options.seed;
  stored.objective = options.objective;
  stored.layout = options.layout;
  for (const ParameterLaw& law : result.layout.laws()) {
    if (law.drive_nodes.size() > 1) {
      stored.layout.by_current[result.layout.names()[law.parameter]] = static_cast<int>(law.drive_nodes.size()) - 1;
    }
  }
  DiagnosisRecords records{diagnosis_json(diagnosis), model_json(result, campaign, stored, command), {}};
  records.diagnosis_file["warnings"] = remarks;

  json page_recordings = json::array();
  const auto count = static_cast<double>(campaign.recordings.size());
  for (const Recording& recording : campaign.recordings) {
    if (done) done(of_errors + (of_forces - of_errors) * static_cast<double>(page_recordings.size()) / count);
    const Target target = make_target(recording, options.objective);
    Prediction prediction;
    prediction.force = predict(result.layout.model(), result.layout.held(), result.terms, target);
    prediction.score = score(prediction.force, recording, options.objective.normalisation);
    const Fit& base = diagnosis.search.base;
    const bool judged = std::ranges::any_of(diagnosis.bench.split().judge, [&](const Judged& one) {
      return one.recording.file == recording.file && one.from == 0;
    });
    page_recordings.push_back(recording_json(recording, prediction, judged ? "held out in the check" : "fit",
                                             campaign.recordings.size(),
                                             predict(base.layout->model(), base.layout->held(), base.terms, target)));
  }
  if (done) done(of_forces);
  json page = {{"title", "Diagnosis of " + std::string(diagnosis.search.base.layout->model().law->title)},
               {"subtitle", fmt::format("{} recordings", campaign.recordings.size())},
               {"version", HYSTERON_VERSION},
               {"command", command},
               {"seed", options.seed},
               {"normalisation", word_of(options.objective.normalisation)},
               {"weighting", word_of(options.objective.weighting)},
               {"recordings", page_recordings},
               {"data", data_json(campaign)},
               {"diagnosis", records.diagnosis_file},
               {"curves", curves_json(diagnosis, campaign, options.objective)},
               {"notes", diagnosis.notes},
               {"warnings", remarks},
               {"solvers", json::array()},
               {"provenance", records.model_file["provenance"]}};
  page["model"] = model_card_json(result.layout.model());
  page["parameters"] = json::array();
  for (const Estimate& row : result.estimates) {
    page["parameters"].push_back(estimate_json(row, result.layout));
  }
  page["correlation"] = correlation_json(result, campaign.recordings.front().drive_kind);
  page["sensitivity"] = sensitivity_json(result);
  const Search& search = diagnosis.search;
  page["summary"] = json::array({{{"label", "Held-out NRMSE, base model"},
                                  {"value", format_number(search.base.heldout, 3)},
                                  {"note", search.base.what.model}},
                                 {{"label", "Held-out NRMSE, augmented"},
                                  {"value", format_number(search.augmented.heldout, 3)},
                                  {"note", diagnosis.bench.split().how}},
                                 {{"label", "Noise floor, held out"},
                                  {"value", format_number(diagnosis.noise_floor_heldout, 3)},
                                  {"note", "fitted " + format_number(diagnosis.noise_floor, 3) + ", by " +
                                               std::string(word_of(diagnosis.noise_floor_method)) +
                                               (diagnosis.noise_floor_method == NoiseMethod::cycles
                                                    ? ""
                                                    : "; at least: slow noise is not seen where no motion repeats")}}});
  records.page = std::move(page);
  return records;
}

}  // namespace hysteron
