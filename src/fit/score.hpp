// How far a predicted force is from a recorded one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

enum class Normalisation { max_abs, range, standard_deviation, mean_abs };
enum class Weighting { per_recording, pooled };

// Throws InputError for an unknown word.
Normalisation normalisation_of(const std::string& word);
std::string_view word_of(Normalisation normalisation);
// What a force signal is divided by; throws InputError naming the file when it is zero.
double normaliser(const Recording& recording, Normalisation normalisation);

struct Score {
  double nrmse;
  double rmse;         // N
  double fit_percent;  // 100 (1 - RMSE / standard deviation)
};
Score score(const std::vector<double>& predicted, const Recording& recording, Normalisation normalisation);
// Over recordings: root mean square of NRMSE, or pooled over samples and divided by the largest normaliser of
// `normalised_by`, so that figures of several groups of recordings can be compared; empty: of `recordings`.
double overall(const std::vector<Score>& scores, const std::vector<const Recording*>& recordings,
               Normalisation normalisation, Weighting weighting,
               const std::vector<const Recording*>& normalised_by = {});

}  // namespace hysteron
