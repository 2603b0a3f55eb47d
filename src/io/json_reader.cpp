#include "io/json_reader.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/nesting.hpp"
#include "io/text.hpp"

namespace hysteron {

using nlohmann::json;

json parse_json(std::string_view text, const std::string& file, const std::string& expected) {
  if (nested_too_deeply(text)) {
    throw InputError(file, 0, "is nested deeper than " + std::to_string(deepest_nesting) + " levels, " + expected);
  }
  std::vector<std::set<std::string>> open;
  const auto look = [&](int /*depth*/, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) {
      open.emplace_back();
    } else if (event == json::parse_event_t::object_end) {
      open.pop_back();
    } else if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second) {
      throw InputError(file, 0,
                       "key " + in_quotes(value.get<std::string>()) + " is given twice in one object, expected once");
    }
    return true;
  };
  try {
    return json::parse(text, look);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw InputError(file, 1 + static_cast<int>(std::count(text.begin(), end, '\n')), "not valid JSON, " + expected);
  } catch (const json::out_of_range&) {
    throw InputError(file, 0, "holds a number beyond the range of a double, " + expected);
  }
}

}  // namespace hysteron
