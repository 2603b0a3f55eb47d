// What the words of a row above numbers are: names of columns, or units below them.
#pragma once

#include <span>
#include <string_view>

namespace hysteron {

// "[mm]" and "(mm)" -> "mm".
[[nodiscard]] std::string_view without_brackets(std::string_view unit);

// Whether a row between a row of words and numbers holds the names itself, so that what stands above is a title: more
// of its cells name a channel, or have a unit behind a name, than are units.
[[nodiscard]] bool names_columns(std::span<const std::string_view> cells);

// Whether a cell is a unit.
[[nodiscard]] bool has_a_unit(std::span<const std::string_view> cells);

}  // namespace hysteron
