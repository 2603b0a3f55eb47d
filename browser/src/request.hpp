// What the page asks for, as JSON, in the words of the tasks. The same words as the program's options.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diagnose/diagnose.hpp"
#include "task/fit.hpp"

namespace hysteron::browser {

// Throw InputError for what is missing or of another type.
[[nodiscard]] FitRequest fit_request(const nlohmann::json& asked);
[[nodiscard]] DiagnoseOptions diagnose_options(const nlohmann::json& asked);
// Conditions that its laws follow, which the reader keeps.
[[nodiscard]] std::vector<std::string> conditions_of(const nlohmann::json& asked);
// The command of the program that does the same.
[[nodiscard]] std::string command_of(const nlohmann::json& asked);

}  // namespace hysteron::browser
