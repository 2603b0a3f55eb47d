// What hypotheses are fitted on.
#pragma once

#include <string>
#include <vector>

#include "diagnose/options.hpp"

namespace hysteron {

// Samples of all recordings that the base and the augmented model are fitted on; every sample is predicted in the end.
inline constexpr std::size_t fine_samples = 8000;

// The split itself, few recordings and samples to compare hypotheses, more of them for what a search ends with. One
// box; only `whole` and `every` see the held-out recordings.
struct Workbenches {
  Workbench whole;
  Workbench quick;
  Workbench fine;
  Workbench every;  // as fine, of all recordings
};

// Where the laws of the base model are the program's own choice, a note says so.
Workbenches workbenches_of(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                           std::vector<std::string>& notes);

}  // namespace hysteron
