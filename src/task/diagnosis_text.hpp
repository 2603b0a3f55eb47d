// A diagnosis in a terminal, from its record alone: what diagnose prints, and report of an earlier one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace hysteron {

// Verdict, summary, errors, names, places, what could not be seen, notes. `record` is a diagnosis.json of schema 1 or
// 2; what schema 1 does not have is left out. Throws InputError, opened by `path`, where a field is missing or of
// another type than the schema's.
std::string diagnosis_text(const nlohmann::json& record, const std::string& path);

// diagnosis.json of a folder. Throws InputError for a file that is missing, not JSON, or of another schema.
nlohmann::json read_diagnosis(const std::string& path);
// The same of the text of a file; `path` opens the messages.
nlohmann::json parse_diagnosis(std::string_view text, const std::string& path);

}  // namespace hysteron
