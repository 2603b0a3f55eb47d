#pragma once

#include <span>
#include <string>

namespace hysteron {

// CSV text: the names, which hold no comma, and one row per sample of columns of equal length, in the shortest digits
// that read back to the same numbers.
[[nodiscard]] std::string csv_of_columns(std::span<const std::string> names,
                                         std::span<const std::span<const double>> columns);

}  // namespace hysteron
