// Several models on the same recordings: `hysteron compare`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/recording.hpp"
#include "fit/objective.hpp"
#include "task/model_file.hpp"

namespace hysteron {

struct ComparedModel {
  std::string file;  // names the model where its law and effects do not tell it apart
  StoredModel stored;
};

struct ModelComparison {
  nlohmann::json file;  // compare.json
  nlohmann::json page;  // for compare_page_html
};

// Errors of every model on every recording; criteria on those that all models were fitted on; what the residuals look
// like. `command` is what it can be made again by. `remarks` are of what the models are asked beyond what they were
// fitted on. Throws InputError where laws of a model follow another drive or a condition that a recording does not
// hold, or its force a rate that it does not know, WorkError where a simulation does not stay finite.
ModelComparison compare_models(const std::vector<ComparedModel>& models, const std::vector<Recording>& recordings,
                               const ObjectiveOptions& objective, const std::string& command,
                               std::vector<std::string>& remarks);

// models.csv and recordings.csv of a compare.json and, if wanted, tables.mat with both: name and bytes.
std::vector<std::pair<std::string, std::string>> comparison_tables(const nlohmann::json& file, bool mat);

// What the command prints of a compare.json.
std::string comparison_text(const nlohmann::json& file);

}  // namespace hysteron
