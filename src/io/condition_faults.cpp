#include "io/condition_faults.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/conditions.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

// What a number is inside (condition_unit) and the units that are expected of it.
struct Measured {
  std::string_view inside;
  std::string_view units;
};

// By the last word of its name; nothing where that does not say what it measures.
std::optional<Measured> measured_by(std::string_view name) {
  const std::string lower = lower_case(trimmed(name));
  const std::string_view word = std::string_view(lower).substr(lower.find_last_of(" _-.") + 1);
  if (word == "pressure") return Measured{"Pa", "Pa, bar, psi"};
  if (word == "frequency") return Measured{"Hz", "Hz"};
  for (const std::string_view time :
       {clock_condition, std::string_view("hours"), std::string_view("minutes"), std::string_view("days"),
        std::string_view("duration"), std::string_view("age")}) {
    if (word == time) return Measured{"s", accepted_units(Quantity::time)};
  }
  // A single letter at the end of a name may be anything.
  const auto quantity = word.size() > 1 || word == lower ? quantity_of_name(word) : std::nullopt;
  if (quantity == Quantity::temperature) return Measured{"degC", accepted_units(*quantity)};
  if (quantity == Quantity::current) return Measured{"A", accepted_units(*quantity)};
  if (quantity == Quantity::voltage) return Measured{"V", accepted_units(*quantity)};
  return std::nullopt;
}

// What stands behind the number that the text begins with; nothing where it begins with none.
std::optional<std::string_view> behind_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return trimmed(text.substr(static_cast<std::size_t>(read.ptr - text.data())));
}

// A letter, the sign of a degree or a part in hundred, or the one of "1/min".
bool may_begin_unit(std::string_view text) {
  if (text.starts_with("1/")) return true;
  // Plus or minus, the dash of a range, the dots of one, and the minus of printed text are no letters.
  for (const std::string_view sign : {"\xC2\xB1", "\xE2\x80\x93", "\xE2\x80\xA6", "\xE2\x88\x92"}) {
    if (text.starts_with(sign)) return false;
  }
  const auto byte = static_cast<unsigned char>(text.front());
  return byte >= 0x80 || byte == '%' || std::isalpha(byte) != 0;
}

}  // namespace

std::string fault_of_condition(std::string_view name, std::string_view text) {
  const std::optional<std::string_view> unit = behind_number(text);
  if (!unit || unit->empty()) return {};
  const std::string of_name = in_quotes(text) + " of " + in_quotes(name);
  if (unit->starts_with(',')) return of_name + " has a comma in its number, expected a decimal point";
  if (!may_begin_unit(*unit)) {
    return of_name + " has " + in_quotes(*unit) +
           " behind its number, which is no unit, expected for example \"2.1 bar\"";
  }
  const std::optional<Measured> measured = measured_by(name);
  const bool known = is_any_unit(*unit) || find_pressure(*unit).has_value();
  if (!measured || !known || condition_unit(*unit).inside == measured->inside) return {};
  return of_name + " has a unit of another quantity, expected one of " + std::string(measured->units);
}

}  // namespace hysteron
