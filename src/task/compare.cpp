#include "task/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "compare/criteria.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "fit/predict.hpp"
#include "fit/score.hpp"
#include "fit/weighting.hpp"
#include "io/csv_text.hpp"
#include "io/mat5_writer.hpp"
#include "report/csv.hpp"
#include "report/terminal.hpp"
#include "task/finite.hpp"
#include "task/guesses.hpp"
#include "task/remarks.hpp"
#include "task/residual_record.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

// At most this many points of a recording go into the page.
constexpr std::size_t page_points = 700;

struct Compared {
  std::string label;
  StoredModel stored;
  std::vector<bool> fitted_on;  // one a recording
  std::vector<std::vector<double>> force;
  std::vector<Score> scores;  // one a recording
  double overall = 0.0;
  std::optional<double> fitted, unseen;
  ResidualFacts facts;  // on all recordings
  std::optional<Criteria> criteria;
};

// The law with its effects, and the file where that does not tell models apart.
void label(std::vector<Compared>& models, const std::vector<ComparedModel>& given) {
  std::vector<std::string> laws;
  for (const Compared& model : models) {
    std::string text(model.stored.model.law->id);
    for (const Part* effect : model.stored.model.effects) {
      text += " + " + std::string(effect->id);
    }
    laws.push_back(text);
  }
  for (std::size_t k = 0; k < models.size(); ++k) {
    const std::filesystem::path path(given[k].file);
    const std::string file =
        path.is_absolute() ? (path.parent_path().filename() / path.filename()).string() : path.string();
    models[k].label = std::ranges::count(laws, laws[k]) > 1 ? laws[k] + " (" + file + ")" : laws[k];
  }
}

std::vector<std::vector<double>> residuals_of(const Compared& model, const std::vector<Recording>& recordings,
                                              const std::vector<std::size_t>& which, Normalisation normalisation) {
  std::vector<std::vector<double>> result;
  for (const std::size_t r : which) {
    result.push_back(normalised_residual(recordings[r], model.force[r], normalisation));
  }
  return result;
}

// Over recordings, as everywhere: the root mean square of theirs, or pooled and over the largest normaliser of all.
std::optional<double> overall_of(const Compared& model, const std::vector<Recording>& recordings,
                                 const ObjectiveOptions& objective, const std::vector<std::size_t>& which) {
  if (which.empty()) {
    return std::nullopt;
  }
  std::vector<Score> scores;
  for (const std::size_t r : which) scores.push_back(model.scores[r]);
  return overall(scores, refer_to(recordings, which), objective.normalisation, objective.weighting,
                 refer_to(recordings));
}

json number_or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json loops_json(const Recording& recording, std::size_t r, const std::vector<Compared>& models) {
  json row = {{"file", recording.file}};
  const std::size_t stride = (recording.size() + page_points - 1) / page_points;
  for (const char* key : {"time", "displacement_mm", "velocity_mm_s", "force_n"}) {
    row[key] = json::array();
  }
  row["models"] = json::array();
  for (std::size_t k = 0; k < models.size(); ++k) {
    row["models"].push_back(json::array());
  }
  const auto digits = [](double value) { return std::stod(fmt::format("{:.6g}", value)); };
  for (std::size_t n = 0; n < recording.size(); n += stride) {
    row["time"].push_back(digits(recording.time[n]));
    row["displacement_mm"].push_back(digits(1e3 * recording.displacement[n]));
    row["velocity_mm_s"].push_back(digits(1e3 * recording.velocity[n]));
    row["force_n"].push_back(digits(recording.force[n]));
    for (std::size_t k = 0; k < models.size(); ++k) {
      row["models"][k].push_back(std::isfinite(models[k].force[r][n]) ? json(digits(models[k].force[r][n]))
                                                                      : json(nullptr));
    }
  }
  return row;
}

}  // namespace

ModelComparison compare_models(const std::vector<ComparedModel>& given, const std::vector<Recording>& recordings,
                               const ObjectiveOptions& objective, const std::string& command,
                               std::vector<std::string>& remarks) {
  std::vector<Compared> models;
  for (const ComparedModel& one : given) {
    models.emplace_back().stored = one.stored;
  }
  label(models, given);
  for (Compared& model : models) {
    check_rate(model.stored, recordings);
    follow_conditions(model.stored, recordings);
    for (const Recording& recording : recordings) model.fitted_on.push_back(was_fitted_on(model.stored, recording));
  }
  std::vector<std::size_t> all;
  std::vector<std::size_t> common;  // fitted by every model
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    all.push_back(r);
    if (std::ranges::all_of(models, [&](const Compared& model) { return model.fitted_on[r]; })) {
      common.push_back(r);
    }
  }
  for (std::size_t k = 0; k < models.size(); ++k) {
    Compared& model = models[k];
    append(remarks, guesses_of(model.stored, given[k].file, recordings));
    append(remarks, beyond_fitted(model.stored, model.label, recordings));
    refuse_excitation(model.stored, model.label, recordings, remarks);
    std::vector<std::size_t> seen;
    std::vector<std::size_t> unseen;
    for (const std::size_t r : all) {
      const Recording& recording = recordings[r];
      check_drive(model.stored, model.label, recording);
      model.force.push_back(
          predict(model.stored.model, model.stored.held, model.stored.terms, make_target(recording, objective)));
      if (const auto time = diverges_at(model.force.back(), recording)) {
        throw WorkError(fmt::format("{}: the simulation of {} does not stay finite from {:g} s on", recording.file,
                                    model.label, *time));
      }
      model.scores.push_back(score(model.force.back(), recording, objective.normalisation));
      (model.fitted_on[r] ? seen : unseen).push_back(r);
    }
    model.overall = *overall_of(model, recordings, objective, all);
    model.fitted = overall_of(model, recordings, objective, seen);
    model.unseen = overall_of(model, recordings, objective, unseen);
    model.facts = residual_facts(residuals_of(model, recordings, all, objective.normalisation));
  }
  std::optional<double> effective;
  if (!common.empty()) {
    std::vector<ResidualFacts> facts;
    for (const Compared& model : models) {
      facts.push_back(residual_facts(residuals_of(model, recordings, common, objective.normalisation)));
    }
    // One number of samples for all, that of the residual which holds the least besides noise.
    effective = std::ranges::min_element(facts, {}, &ResidualFacts::mean_square)->effective_samples();
    for (std::size_t k = 0; k < models.size(); ++k) {
      models[k].criteria = criteria(facts[k].mean_square, *effective, models[k].stored.searched);
    }
  }
  double best_aic = 0.0;
  double best_bic = 0.0;
  if (effective) {
    best_aic = std::ranges::min(models, {}, [](const Compared& m) { return m.criteria->aic; }).criteria->aic;
    best_bic = std::ranges::min(models, {}, [](const Compared& m) { return m.criteria->bic; }).criteria->bic;
  }

  const std::string normalisation(word_of(objective.normalisation));
  const std::string criteria_note =
      effective ? fmt::format(
                      "AIC and BIC: n ln(mean square) + penalty with n = {:.0f}, the effective sample size of the "
                      "residual of the best model on the {} recording{} that every model was fitted on; "
                      "differences from the best are shown",
                      *effective, common.size(), common.size() == 1 ? "" : "s")
                : "AIC and BIC: none, since no recording was fitted by every model";
  json file = {{"schema", "hysteron.compare/1"},
               {"normalisation", normalisation},
               {"weighting", std::string(word_of(objective.weighting))},
               {"effective_samples", number_or_null(effective)},
               {"criteria_recordings", json::array()},
               {"note", criteria_note},
               {"models", json::array()},
               {"recordings", json::array()}};
  for (const std::size_t r : common) {
    file["criteria_recordings"].push_back(recordings[r].file);
  }
  for (const Compared& model : models) {
    json effects = json::array();
    for (const Part* effect : model.stored.model.effects) {
      effects.push_back(effect->id);
    }
    file["models"].push_back({{"label", model.label},
                              {"model", model.stored.model.law->id},
                              {"effects", effects},
                              {"free_parameters", model.stored.searched},
                              {"nrmse",
                               {{"overall", model.overall},
                                {"fitted", number_or_null(model.fitted)},
                                {"unseen", number_or_null(model.unseen)}}},
                              {"aic", model.criteria ? json(model.criteria->aic) : json(nullptr)},
                              {"bic", model.criteria ? json(model.criteria->bic) : json(nullptr)},
                              {"delta_aic", model.criteria ? json(model.criteria->aic - best_aic) : json(nullptr)},
                              {"delta_bic", model.criteria ? json(model.criteria->bic - best_bic) : json(nullptr)},
                              {"residual", residual_json(model.facts)}});
  }
  for (const std::size_t r : all) {
    json row = {{"file", recordings[r].file}, {"sha256", recordings[r].sha256}};
    for (const char* key : {"nrmse", "rmse_n", "fit_percent", "fitted"}) {
      row[key] = json::array();
    }
    for (const Compared& model : models) {
      row["nrmse"].push_back(model.scores[r].nrmse);
      row["rmse_n"].push_back(model.scores[r].rmse);
      row["fit_percent"].push_back(model.scores[r].fit_percent);
      row["fitted"].push_back(static_cast<bool>(model.fitted_on[r]));
    }
    file["recordings"].push_back(std::move(row));
  }
  json page = file;
  page["title"] = "Comparison of models";
  page["version"] = HYSTERON_VERSION;
  page["command"] = command;
  page["loops"] = json::array();
  for (const std::size_t r : all) {
    page["loops"].push_back(loops_json(recordings[r], r, models));
  }
  return {std::move(file), std::move(page)};
}

std::vector<std::pair<std::string, std::string>> comparison_tables(const json& file, bool mat) {
  const auto number = [](const json& value) {
    return value.is_null() ? std::string() : fmt::format("{}", value.get<double>());
  };
  std::vector<std::vector<std::string>> models;
  for (const json& model : file["models"]) {
    const json& nrmse = model["nrmse"];
    models.push_back({name_cell(model["label"].get<std::string>()),
                      std::to_string(model["free_parameters"].get<std::size_t>()), number(nrmse["overall"]),
                      number(nrmse["fitted"]), number(nrmse["unseen"]), number(model["aic"]), number(model["bic"]),
                      number(model["residual"]["autocorrelation"][0]), number(model["residual"]["lags_outside"])});
  }
  std::vector<std::vector<std::string>> recordings;
  for (const json& recording : file["recordings"]) {
    for (std::size_t k = 0; k < models.size(); ++k) {
      recordings.push_back({name_cell(recording["file"].get<std::string>()), models[k][0],
                            recording["fitted"][k].get<bool>() ? "1" : "0", number(recording["nrmse"][k]),
                            number(recording["rmse_n"][k]), number(recording["fit_percent"][k])});
    }
  }
  const std::string of_models = csv_table({"model", "free_parameters", "nrmse_overall", "nrmse_fitted", "nrmse_unseen",
                                           "aic", "bic", "lag_1_correlation", "lags_outside"},
                                          models);
  const std::string of_recordings =
      csv_table({"recording", "model", "fitted", "nrmse", "rmse_n", "fit_percent"}, recordings);
  std::vector<std::pair<std::string, std::string>> files = {{"models.csv", of_models},
                                                            {"recordings.csv", of_recordings}};
  if (mat) {
    files.emplace_back("tables.mat",
                       mat5_of({{"models", mat_table(of_models)}, {"recordings", mat_table(of_recordings)}}));
  }
  return files;
}

std::string comparison_text(const json& file) {
  const auto cell = [](const json& value) {
    return value.is_null() ? std::string("-") : format_number(value.get<double>(), 4);
  };
  const auto fixed = [](const json& value) {
    return value.is_null() ? std::string("-") : fmt::format("{:.1f}", value.get<double>());
  };
  std::string names;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> head = {"recording"};
  for (const json& model : file["models"]) {
    const std::string number = std::to_string(rows.size() + 1);
    names += fmt::format("{}  {}\n", number, printable(model["label"].get<std::string>()));
    const json& residual = model["residual"];
    rows.push_back({number, std::to_string(model["free_parameters"].get<std::size_t>()), cell(model["nrmse"]["fitted"]),
                    cell(model["nrmse"]["unseen"]), fixed(model["delta_aic"]), fixed(model["delta_bic"]),
                    fmt::format("{:.3f}", residual["autocorrelation"][0].get<double>()),
                    fmt::format("{:.1f}", 100.0 * residual["lags_outside"].get<double>())});
    head.push_back("NRMSE " + number);
  }
  std::string text =
      names + "\n" + table({"model", "free", "fitted", "unseen", "dAIC", "dBIC", "lag 1", "not white [%]"}, rows) +
      wrapped("free: parameters; fitted, unseen: NRMSE on recordings it was fitted on and on others, normalised by " +
              file["normalisation"].get<std::string>() +
              "; lag 1: correlation of neighbouring residuals; not white: lags outside the band of noise") +
      "\n";
  rows.clear();
  bool starred = false;
  for (const json& recording : file["recordings"]) {
    std::vector<std::string> row = {recording["file"].get<std::string>()};
    for (std::size_t k = 0; k < recording["nrmse"].size(); ++k) {
      const bool unseen = !recording["fitted"][k].get<bool>();
      row.push_back(cell(recording["nrmse"][k]) + (unseen ? "*" : ""));
      starred = starred || unseen;
    }
    rows.push_back(std::move(row));
  }
  return text + table(head, rows) + (starred ? "* not fitted on by that model\n" : "") +
         wrapped(file["note"].get<std::string>());
}

}  // namespace hysteron
