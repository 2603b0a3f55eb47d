#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hysteron {

// JSON text of a result file: two-space indent, shortest round-trip numbers, final newline.
std::string json_text(const nlohmann::json& value);

}  // namespace hysteron
