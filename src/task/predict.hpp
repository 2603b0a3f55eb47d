// What a stored model predicts of recordings: `hysteron simulate` and `hysteron score`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/score.hpp"
#include "task/model_file.hpp"

namespace hysteron {

// Force in N on the motion of a recording, of whose own force only how it begins is looked at; it may be missing.
// `path` is the model's in messages; `remarks` are of guesses_of. Throws InputError where the laws follow
// another drive or a condition that the recording does not hold, or the force a rate that it does not know, WorkError
// where the simulation does not stay finite.
std::vector<double> simulated_force(StoredModel stored, const std::string& path, const Recording& recording,
                                    double tolerance, std::vector<std::string>& remarks);

struct CampaignScore {
  std::vector<Score> recordings;  // in their order
  double overall = 0.0;           // NRMSE
};
// Throws as simulated_force does.
CampaignScore score_campaign(StoredModel stored, const std::string& path, const std::vector<Recording>& recordings,
                             const ObjectiveOptions& objective, std::vector<std::string>& remarks);
// The table of recordings as CSV text, as `hysteron score --out` writes it.
std::string score_csv(const CampaignScore& score, const std::vector<Recording>& recordings);
// As `hysteron score --json` writes it.
nlohmann::json score_json(const CampaignScore& score, const std::vector<Recording>& recordings,
                          Normalisation normalisation);

}  // namespace hysteron
