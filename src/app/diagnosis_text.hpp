// A diagnosis in a terminal, from its record alone: what diagnose prints, and report of an earlier one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron::app {

// Verdict, summary, errors, names, places, what could not be seen, notes. `record` is a diagnosis.json of schema 1 or
// 2; what schema 1 does not have is left out. Throws nlohmann::json::exception where a field is of another type than
// the schema's.
std::string diagnosis_text(const nlohmann::json& record);

// diagnosis.json of a folder. Throws InputError for a file that is missing, not JSON, or of another schema.
nlohmann::json read_diagnosis(const std::string& path);

}  // namespace hysteron::app
