#include "io/header_row.hpp"

#include <algorithm>

#include "io/channels.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

// "A", "V" and "F" are names and units.
bool is_unit(std::string_view cell) { return is_any_unit(without_brackets(cell)); }

bool is_name(std::string_view cell) {
  const Column column = split_column(cell);
  return quantity_of_name(column.name).has_value() || (!column.name.empty() && is_any_unit(column.unit));
}

}  // namespace

std::string_view without_brackets(std::string_view unit) {
  unit = without_blanks(unit);
  if (unit.size() >= 2 &&
      ((unit.front() == '[' && unit.back() == ']') || (unit.front() == '(' && unit.back() == ')'))) {
    return without_blanks(unit.substr(1, unit.size() - 2));
  }
  return unit;
}

bool names_columns(std::span<const std::string_view> cells) {
  return std::ranges::count_if(cells, is_name) > std::ranges::count_if(cells, is_unit);
}

bool has_a_unit(std::span<const std::string_view> cells) { return std::ranges::any_of(cells, is_unit); }

}  // namespace hysteron
