// What `fit --stages two` says of laws found in two stages, beside the fit of all coefficients at once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fit/two_stage.hpp"

namespace hysteron {

// The joint fit is the chosen solver's, on the same recordings as the two stages, before any refit on all.
nlohmann::json stages_json(const TwoStage& two, const Identification& joint, const Campaign& campaign);

// The tables of the terminal.
std::string stages_text(const TwoStage& two, const Identification& joint);

}  // namespace hysteron
