// What the record of a fit says of how well its parameters are known: what the report draws.
#pragma once

#include <nlohmann/json.hpp>

#include "fit/identify.hpp"

namespace hysteron {

// `names` of the coordinates told, `values` of the matrix, the pairs `inseparable`, and a `note` in words; null with
// fewer than two parameters.
nlohmann::json correlation_json(const Identification& result, DriveKind drive);

// Scaled sensitivities, the largest first, null where a derivative is not finite.
nlohmann::json sensitivity_json(const Identification& result);

// Where the starts of a solver ended: `costs`, the best first, how many `reached` the best within the share `same`;
// null for a run of fewer than two.
nlohmann::json starts_json(const RunResult& run);

}  // namespace hysteron
