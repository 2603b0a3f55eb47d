// Findings as diagnosis.json holds them: its "evidence".
#pragma once

#include <nlohmann/json.hpp>

#include "diagnose/judge/findings.hpp"

namespace hysteron {

// Squares are of NRMSE.
nlohmann::json findings_json(const Findings& findings);
// The inverse. Throws nlohmann::json::exception where something is missing.
Findings findings_from(const nlohmann::json& json);

}  // namespace hysteron
