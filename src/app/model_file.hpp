// model.json: everything needed to simulate an identified model on any machine.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "fit/identify.hpp"

namespace hysteron::app {

struct StoredModel {
  CompositeModel model;
  std::vector<double> held;
  std::vector<Term> terms;
  DriveKind drive = DriveKind::none;  // what the laws follow, by their units; none without laws in the drive
  std::size_t searched = 0;           // terms that were fitted, not held
  std::set<std::string> fitted_on;    // sha256 of the recordings
};

nlohmann::json model_json(const Identification& result, const Campaign& campaign, const IdentifyOptions& options);

// Throws InputError for a file that is missing, not JSON, of another schema, or inconsistent with its model: a
// parameter that is missing, given twice or in another unit than the model's, a law with terms left out.
StoredModel read_model(const std::string& path);
// The same of the text of a file; `path` opens the messages.
StoredModel parse_model(std::string_view text, const std::string& path);

// Throws InputError where laws in a current would be given a voltage or the other way round; says on standard error
// where a recording has neither and counts as zero drive. `path` is the model's.
void check_drive(const StoredModel& stored, const std::string& path, const Recording& recording);

}  // namespace hysteron::app
