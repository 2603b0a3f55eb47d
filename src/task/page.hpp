// Rows of the report page that fit and diagnose share.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/identify.hpp"

namespace hysteron {

struct Prediction {
  std::vector<double> force;  // N
  Score score;
  std::vector<double> motion = {};  // m, of a mass on the damper
};

// A recording with its prediction, thinned to what a page of this many recordings can show, or that part of it which
// can be shown with all its periods; `baseline` (N, may be empty) is the force of the model before it was augmented.
nlohmann::json recording_json(const Recording& recording, const Prediction& prediction, const std::string& role,
                              std::size_t recordings, const std::vector<double>& baseline = {});

// Id, title, equations and source of a model with its effects.
nlohmann::json model_card_json(const CompositeModel& model);

// Name and sha256 of every recording.
nlohmann::json data_json(const Campaign& campaign);

nlohmann::json estimate_json(const Estimate& estimate, const Layout& layout);

}  // namespace hysteron
