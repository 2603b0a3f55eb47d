// Holds diagnoses against the opened answers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hysteron::challenge {

enum class Outcome {
  right,      // every detectable cause named, beside foreign ones at least one; or rightly complete; or foreign causes
              // refused (no name, and not complete)
  part,       // of two causes one is named, no name is wrong
  in_set,     // the cause is in a declared set of candidates
  abstained,  // no name, where a name was possible or nothing is missing
  missed,     // complete although the cause could be seen
  wrong,      // a name, alone or as a set, that holds no cause
  failed      // no diagnosis
};
[[nodiscard]] std::string_view name_of(Outcome outcome);

// An effect whose energy beyond the reach of the law's parameters exceeds this many noise variances, per independent
// sample, could have been seen.
inline constexpr double detectable_from = 100.0;

// A stated place is right where the true change, less what the law takes up of it, is this much denser than on the
// whole: the least density at which a place is stated.
inline constexpr double place_from = 1.25;

// One campaign: an answer as answer_of() writes it and a diagnosis as the contract has it (null: none). Names are the
// effects of grade supported or better, or without a grade (schema 1); suggestions are never names.
// {"campaign","level","truth":[ids],"forms":[ids],"foreign_power_over_strongest","detectable","outcome","detected","verdict",
//  "answer":[{"id","set","grade","confidence","name","right"}],"named":[those of them that are names without a rival],
//  "candidates":[ids],"wrong_names":[ids],"places":[{"where","stated","true","right"}],
//  "parameters":[{"effect","name","true","found","relative_error","inside_ci95"}],"nrmse_heldout_before",
//  "nrmse_heldout_after","floor","share_of_peak","left_over_noise"}
[[nodiscard]] nlohmann::json score_campaign(const nlohmann::json& answer, const nlohmann::json& diagnosis);

// Stated probability against frequency, bin by bin, of the statements in the "answer" of every campaign: names and
// suggestions together, a set right where it holds a cause. [{"from","to","right":rate,"mean_confidence"}]
[[nodiscard]] nlohmann::json reliability_of(const nlohmann::json& campaigns);

// {"hits","trials","rate","low95","high95"}, bounds of Clopper and Pearson.
[[nodiscard]] nlohmann::json rate_of(int hits, int trials);

// Rates with Clopper-Pearson bounds over all, per level, effect and size; confusion matrix; reliability of the stated
// confidence; parameter errors; held-out errors. `campaigns`: what score_campaign gave.
[[nodiscard]] nlohmann::json summarise(const nlohmann::json& campaigns);

}  // namespace hysteron::challenge
