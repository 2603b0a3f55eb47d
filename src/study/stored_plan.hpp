// The plan of a study as its store holds it, read by `report` and `merge`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hysteron {

// plan_json() from its text; `store` opens the messages. Throws InputError where anything is missing, of another type,
// or points at what is not there: what is worked out from a plan takes its numbers as they are.
[[nodiscard]] nlohmann::json parse_plan(const std::string& text, const std::string& store);

}  // namespace hysteron
