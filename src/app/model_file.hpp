// model.json: everything needed to simulate an identified model on any machine.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/identify.hpp"

namespace hysteron::app {

struct StoredModel {
  CompositeModel model;
  std::vector<double> held;
  std::vector<Term> terms;
};

nlohmann::json model_json(const Identification& result, const Campaign& campaign, const IdentifyOptions& options);

// Throws InputError for a file that is missing, not JSON, of another schema, or inconsistent with its model.
StoredModel read_model(const std::string& path);

}  // namespace hysteron::app
