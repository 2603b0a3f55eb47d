#include "task/predict.hpp"

#include <fmt/format.h>

#include "fit/predict.hpp"
#include "fit/start.hpp"
#include "io/csv_text.hpp"
#include "report/csv.hpp"
#include "task/finite.hpp"
#include "task/guesses.hpp"
#include "task/remarks.hpp"

namespace hysteron {
namespace {

std::vector<double> force_on(const StoredModel& stored, const std::string& path, const Recording& recording,
                             const ObjectiveOptions& objective) {
  check_drive(stored, path, recording);
  std::vector<double> force = predict(stored.model, stored.held, stored.terms, make_target(recording, objective));
  require_finite(force, recording);
  return force;
}

}  // namespace

std::vector<double> simulated_force(StoredModel stored, const std::string& path, const Recording& recording,
                                    double tolerance, std::vector<std::string>& remarks) {
  Recording motion = recording;
  // Of the force only how it begins: in its cycle, or from nothing.
  motion.start = start_of(recording);
  motion.force.clear();
  ObjectiveOptions objective;
  objective.tolerance = tolerance;
  check_rate(stored, {motion});
  follow_conditions(stored, {motion});
  remarks = guesses_of(stored, path, {motion});
  append(remarks, beyond_fitted(stored, path, {motion}));
  return force_on(stored, path, motion, objective);
}

CampaignScore score_campaign(StoredModel stored, const std::string& path, const std::vector<Recording>& recordings,
                             const ObjectiveOptions& objective, std::vector<std::string>& remarks) {
  CampaignScore result;
  check_rate(stored, recordings);
  follow_conditions(stored, recordings);
  remarks = guesses_of(stored, path, recordings);
  append(remarks, beyond_fitted(stored, path, recordings));
  refuse_excitation(stored, path, recordings, remarks);
  for (const Recording& recording : recordings) {
    const std::vector<double> force = force_on(stored, path, recording, objective);
    result.recordings.push_back(score(force, recording, objective.normalisation));
  }
  result.overall = overall(result.recordings, refer_to(recordings), objective.normalisation, objective.weighting);
  return result;
}

std::string score_csv(const CampaignScore& score, const std::vector<Recording>& recordings) {
  std::vector<std::vector<std::string>> cells;
  for (std::size_t k = 0; k < score.recordings.size(); ++k) {
    const Score& one = score.recordings[k];
    cells.push_back({name_cell(recordings[k].file), fmt::format("{}", one.nrmse), fmt::format("{}", one.rmse),
                     fmt::format("{}", one.fit_percent)});
  }
  return csv_table({"recording", "nrmse", "rmse [N]", "fit_percent"}, cells);
}

nlohmann::json score_json(const CampaignScore& score, const std::vector<Recording>& recordings,
                          Normalisation normalisation) {
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t k = 0; k < score.recordings.size(); ++k) {
    rows.push_back({{"file", recordings[k].file},
                    {"nrmse", score.recordings[k].nrmse},
                    {"rmse_n", score.recordings[k].rmse},
                    {"fit_percent", score.recordings[k].fit_percent}});
  }
  return {{"normalisation", word_of(normalisation)}, {"overall", {{"nrmse", score.overall}}}, {"recordings", rows}};
}

}  // namespace hysteron
