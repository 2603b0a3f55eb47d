// A challenge on recordings of a real damper: effects are hidden in them one at a time, beside whatever the damper has
// that its model misses; the recordings as they are, and placebos, are diagnosed with them.
//   OUT/settings.json, OUT/campaign-0000/...      0000 as recorded, the others in an order drawn from the seed
//   OUT/answers.sealed, OUT/seal.sha256           before any diagnosis
//   OUT/diagnoses/campaign-NNNN/diagnosis.json    by diagnose_all (challenge/run.hpp)
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron::challenge {

// One campaign to be made: an id as alter() takes it, and the RMS of its change of force over the residual that the
// base law leaves in the recordings as they are; 0: a size that is drawn, or a placebo.
struct HideTask {
  std::string id;
  double size = 0.0;
};

// Every id at every size (drawn where there is none), and `placebo_count` placebos, of every kind that the recordings
// allow in turn.
[[nodiscard]] std::vector<HideTask> hide_tasks(const std::vector<std::string>& ids, const std::vector<double>& sizes,
                                               int placebo_count, const Campaign& campaign);

// RMS in N of what the base law leaves of the force of a folder's recordings.
using BaseResidual = std::function<double(const std::filesystem::path& data)>;

// Makes and seals one campaign per task; returns the hash. Model and laws of `campaign` go to the campaign files. With
// the settings of an earlier call nothing is made again; with others it is an InputError. `residual` is asked once,
// where a task has a size.
std::string hide_all(const std::filesystem::path& out, const Campaign& campaign, const std::vector<HideTask>& tasks,
                     std::uint64_t seed, const BaseResidual& residual = {});

// Whether the sealed answers of a folder are of effects hidden in recordings. Throws InputError where there are none.
[[nodiscard]] bool is_hidden_in_recordings(const std::filesystem::path& out);

// Opens the seal, holding it against `hash` (empty: the one of seal.sha256), and scores:
// {"schema","seed","seal","base_residual_n","not_diagnosed","as_recorded":{"verdict","named","candidates"},"sizes":[..],
//  "placebos":rate,"names":rate,"reliability":[..],"campaigns":[{"campaign","hidden","placebo","size","share","verdict",
//  "answer","named","candidates","outcome","parameters":[..],"nrmse_heldout_before","nrmse_heldout_after"}]}
// Outcomes: found (named; of several, all), part (some of several), in a set, suggested, in the model (not named, but
// in the augmented model, and not in that of the recordings as they are), not found; wrong: a name that neither was
// hidden nor stands as recorded; of placebos refused or wrong; failed: the diagnosis was. Campaigns not reached are not
// counted. What stands as recorded is neither right nor wrong: it is left out of "answer".
[[nodiscard]] nlohmann::json score_hidden(const std::filesystem::path& out, const std::string& hash);

}  // namespace hysteron::challenge
