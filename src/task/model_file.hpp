// model.json: everything needed to simulate an identified model on any machine.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fit/identify.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Lowest and highest of what a model was fitted on; none of files that do not say it.
struct FittedOver {
  std::optional<std::pair<double, double>> displacement;  // m
  std::optional<std::pair<double, double>> velocity;      // m/s
  std::optional<std::pair<double, double>> drive;         // A or V
  DriveKind drive_kind = DriveKind::none;                 // of `drive`
};

// Member of fitted_over in model.json.
constexpr const char* drive_key(DriveKind kind) { return kind == DriveKind::voltage ? "voltage_v" : "current_a"; }

struct StoredModel {
  CompositeModel model;
  std::vector<double> held;
  std::vector<Term> terms;
  DriveKind drive = DriveKind::none;       // what the laws follow, by their units; none without laws in the drive
  std::vector<ConditionRange> conditions;  // that laws follow, with the range they were fitted over
  std::size_t searched = 0;                // terms that were fitted, not held
  std::set<std::string> fitted_on;         // sha256 of the recordings
  std::set<std::string> fitted_values;     // sha256 of what they hold (io/value_hash.hpp); none of older files
  // Units of the parameters whose entries state none: theirs are taken to be these.
  std::vector<std::pair<std::string, std::string>> assumed_units;
  // Where the laws were fitted, lowest and highest; none of files without laws and of those that do not say it.
  std::optional<std::pair<double, double>> drive_range;      // A or V
  std::optional<std::pair<double, double>> frequency_range;  // Hz
  FittedOver fitted_over;
  // s since 1970 that a law in the clock counts from; none where the clock is no recording's start.
  std::optional<double> clock_since;
  // Identified from the motion of a mass under a force, which the recordings hold in place of the damper's own.
  bool from_response = false;
  std::set<std::string> excited;  // sha256 of these recordings

  [[nodiscard]] bool follows_frequency() const;
};

// `command` is what made it, for its provenance.
nlohmann::json model_json(const Identification& result, const Campaign& campaign, const IdentifyOptions& options,
                          const std::string& command);

// Throws InputError for a file that is missing, not JSON, of another schema, or inconsistent with its model: a
// parameter that is missing, given twice or in another unit than the model's, a law with terms left out.
StoredModel read_model(const std::string& path);
// The same of the text of a file; `path` opens the messages.
StoredModel parse_model(std::string_view text, const std::string& path);

// Where the clock of recordings counts from, s since 1970, if it is that of their starts: of the first of them, unless
// a number was given in its place.
std::optional<double> clock_since(const std::vector<Recording>& recordings);

// Names of the conditions that the laws of models follow, to be read with recordings.
std::vector<std::string> conditions_of(const std::vector<const StoredModel*>& models);
// InputError where --at gives a number for what no parameter of the models follows, which would change nothing.
void refuse_unfollowed(const std::vector<const StoredModel*>& models,
                       const std::map<std::string, ConditionNumber>& values);
// The terms follow the conditions of the recordings, in their order. Throws InputError where a recording lacks one of
// the model, has it in another unit, or has others than the first.
void follow_conditions(StoredModel& stored, const std::vector<Recording>& recordings);
// Terms at constant values of all conditions, which they then no longer follow. Throws InputError for a condition
// without a value, or with one in another unit, and for a value of anything else. `command` opens the message.
void hold_conditions(StoredModel& stored, const std::map<std::string, ConditionNumber>& values,
                     const std::string& command);

// Whether the model was fitted on a recording, or on a copy that holds the same numbers in other bytes.
bool was_fitted_on(const StoredModel& stored, const Recording& recording);

// Throws InputError where a recording has no time and the force depends on the rate (task/rate.hpp).
void check_rate(const StoredModel& stored, const std::vector<Recording>& recordings);

// Throws InputError where laws in a current would be given a voltage or the other way round. `path` is the model's.
void check_drive(const StoredModel& stored, const std::string& path, const Recording& recording);

}  // namespace hysteron
