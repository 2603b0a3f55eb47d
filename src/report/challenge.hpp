// The result of a challenge as text and as a page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron {

// `result`: challenge.json. Tables in Markdown.
std::string challenge_markdown(const nlohmann::json& result);

// The same tables on one page that loads nothing else, with every campaign at the end.
std::string challenge_html(const nlohmann::json& result);

}  // namespace hysteron
