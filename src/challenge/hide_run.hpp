// A challenge on recordings of a real damper: effects are hidden in them one at a time, beside whatever the damper has
// that its model misses; the recordings as they are, and placebos, are diagnosed with them.
//   OUT/settings.json, OUT/campaign-0000/...      0000 as recorded, the others in an order drawn from the seed
//   OUT/answers.sealed, OUT/seal.sha256           before any diagnosis
//   OUT/diagnoses/campaign-NNNN/diagnosis.json    by diagnose_all (challenge/run.hpp)
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron::challenge {

// Makes and seals one campaign per id of `ids` (hideable() or placebos()); returns the hash. Model and laws of
// `campaign` go to the campaign files. With the settings of an earlier call nothing is made again; with others it is an
// InputError.
std::string hide_all(const std::filesystem::path& out, const Campaign& campaign, const std::vector<std::string>& ids,
                     std::uint64_t seed);

// Opens the seal, holding it against `hash` (empty: the one of seal.sha256), and scores:
// {"schema","seed","seal","as_recorded":{"verdict","named"},"campaigns":[{"campaign","hidden","placebo","share",
//  "verdict","named","outcome","parameters":[..],"nrmse_heldout_before","nrmse_heldout_after"}]}
// Outcomes: found (named), in a set, in the model (not named, but in the augmented model, and not in that of the
// recordings as they are), not found; wrong: a name that neither was hidden nor stands as recorded; of
// placebos refused or wrong; failed: no diagnosis.
[[nodiscard]] nlohmann::json score_hidden(const std::filesystem::path& out, const std::string& hash);

}  // namespace hysteron::challenge
