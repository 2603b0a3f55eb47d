// The result of a challenge on recordings of a real damper as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron {

// `result`: hidden.json. Tables in Markdown.
std::string hidden_markdown(const nlohmann::json& result);

}  // namespace hysteron
