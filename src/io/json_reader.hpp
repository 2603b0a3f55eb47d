// What readers of JSON files share: every complaint is an InputError with the file and, where there is one, the line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hysteron {

// The value of a text; `file` opens every message and `expected` ends it ("expected a model.json written by hysteron").
// What is not JSON, a number beyond the range of a double, nesting that no file of ours has, and a key given twice in
// one object, where readers differ in which of the two they keep, are InputErrors.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file, const std::string& expected);

}  // namespace hysteron
