#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hysteron {

// CSV text: the names, which hold no comma, and one row per sample of columns of equal length, in the shortest digits
// that read back to the same numbers.
[[nodiscard]] std::string csv_of_columns(std::span<const std::string> names,
                                         std::span<const std::span<const double>> columns);

// A name as it stands in a cell of a table: control characters as printable() writes them, and a ' before what a
// spreadsheet would take for a formula (= + - @ in front, and no number).
[[nodiscard]] std::string name_cell(std::string_view name);

}  // namespace hysteron
