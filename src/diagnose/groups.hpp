// Recordings that do not belong together: one damper law fits each of them, no one set of its parameters fits all, and
// nothing recorded explains which parameters a recording has. The device was not the same: a valve set anew, a preload,
// another specimen.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/by_recording.hpp"

namespace hysteron {

// A parameter in which the groups differ.
struct Difference {
  std::string parameter;
  std::string meaning;  // "yield force"; may be empty
  std::string unit;
  std::vector<double> values;   // of each group
  std::optional<double> drive;  // at which the values are, where the parameter follows it: the mean of all recordings
  double share = 0.0;           // of what groups take off, what comes back when this one parameter is common
};

struct Belonging {
  std::vector<std::vector<std::string>> groups;  // files, the largest group first
  std::vector<double> nrmse;                     // of each group, fitted by itself
  double together = 0.0;                         // NRMSE of all recordings fitted together
  double apart = 0.0;                            // each group fitted by itself
  bool by_repeats = false;  // told by repeated motions whose forces differ, else by how well the groups hold together
  double chance = 1.0;      // that parameters which scatter from recording to recording hold together so
  std::vector<Difference> differences;  // what parts the groups most comes first
  bool explained = false;               // something known parts the recordings as well as another state of the device
};

// `bench` holds all recordings, those held out too. `base` is of the damper law alone on them, `augmented` the best
// model that was found. Nothing where no groups stand out.
std::optional<Belonging> belonging_of(const Workbench& bench, const ByRecording& base, const Fit& augmented);

// Whether the device was not the same: groups that nothing known explains.
bool mixed(const std::optional<Belonging>& belonging);

// Groups, what differs, and what tells it, without a full stop.
std::string sentence_of(const Belonging& belonging);
nlohmann::json groups_json(const Belonging& belonging);

}  // namespace hysteron
