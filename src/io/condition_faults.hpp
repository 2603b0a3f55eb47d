// What is wrong with a number of a whole recording as somebody wrote it, in campaign.toml or behind --at, although it
// begins as a number does.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

// Of "10,5 degC", "10-12 degC" and, for a temperature, "10 bar": the number holds a comma, what stands behind it is no
// unit, or a unit of another quantity than the condition of this name is. Empty where nothing is wrong, and for a text
// that does not begin with a number.
[[nodiscard]] std::string fault_of_condition(std::string_view name, std::string_view text);

}  // namespace hysteron
