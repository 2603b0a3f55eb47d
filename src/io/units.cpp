#include "io/units.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

struct BaseUnit {
  std::string_view symbol;
  double factor;
  bool prefixed;  // takes SI prefixes
};

// Exact by definition: inch, foot (1959 agreement), pound-force, kilogram-force, standard gravity.
constexpr double standard_gravity = 9.80665;
constexpr double pound_force = 4.4482216152605;

constexpr BaseUnit time_units[] = {
    {"s", 1.0, true},         {"sec", 1.0, false},      {"second", 1.0, false},        {"seconds", 1.0, false},
    {"min", 60.0, false},     {"h", 3600.0, false},     {"msec", 1e-3, false},         {"usec", 1e-6, false},
    {"minutes", 60.0, false}, {"hours", 3600.0, false}, {"milliseconds", 1e-3, false},
};
constexpr BaseUnit length_units[] = {
    {"m", 1.0, true},
    {"meter", 1.0, false},
    {"meters", 1.0, false},
    {"metre", 1.0, false},
    {"metres", 1.0, false},
    {"in", 0.0254, false},
    {"inch", 0.0254, false},
    {"inches", 0.0254, false},
    {"mil", 2.54e-5, false},
    {"ft", 0.3048, false},
    {"foot", 0.3048, false},
    {"feet", 0.3048, false},
    {"millimeter", 1e-3, false},
    {"millimeters", 1e-3, false},
    {"millimetre", 1e-3, false},
    {"millimetres", 1e-3, false},
    {"centimeters", 1e-2, false},
    {"centimetres", 1e-2, false},
};
constexpr BaseUnit force_units[] = {
    {"N", 1.0, true},
    {"newton", 1.0, false},
    {"newtons", 1.0, false},
    {"lbf", pound_force, false},
    {"lb", pound_force, false},
    {"lbs", pound_force, false},
    {"pound", pound_force, false},
    {"pounds", pound_force, false},
    {"pounds-force", pound_force, false},
    {"kilonewtons", 1e3, false},
    {"kip", 1000.0 * pound_force, false},
    {"kips", 1000.0 * pound_force, false},
    {"kgf", standard_gravity, false},
    {"gf", 1e-3 * standard_gravity, false},
    {"tf", 1e3 * standard_gravity, false},
};
constexpr BaseUnit current_units[] = {
    {"A", 1.0, true}, {"amp", 1.0, false}, {"amps", 1.0, false}, {"ampere", 1.0, false}, {"amperes", 1.0, false}};
constexpr BaseUnit voltage_units[] = {{"V", 1.0, true}, {"volt", 1.0, false}, {"volts", 1.0, false}};
constexpr double square_inch = 0.0254 * 0.0254;
constexpr BaseUnit pressure_units[] = {{"Pa", 1.0, true},
                                       {"bar", 1e5, true},
                                       {"psi", pound_force / square_inch, false},
                                       {"ksi", 1e3 * pound_force / square_inch, false},
                                       {"atm", 101325.0, false}};
constexpr BaseUnit gravity_units[] = {{"g", standard_gravity, false}, {"mg", 1e-3 * standard_gravity, false}};

// Both code points of the micro sign occur in files, and the byte of it in texts of Windows (Latin-1).
constexpr std::pair<std::string_view, double> prefixes[] = {
    {"da", 1e1},  {"\xC2\xB5", 1e-6}, {"\xCE\xBC", 1e-6}, {"\xB5", 1e-6}, {"q", 1e-30}, {"r", 1e-27}, {"y", 1e-24},
    {"z", 1e-21}, {"a", 1e-18},       {"f", 1e-15},       {"p", 1e-12},   {"n", 1e-9},  {"u", 1e-6},  {"m", 1e-3},
    {"c", 1e-2},  {"d", 1e-1},        {"h", 1e2},         {"k", 1e3},     {"M", 1e6},   {"G", 1e9},   {"T", 1e12},
    {"P", 1e15},  {"E", 1e18},        {"Z", 1e21},        {"Y", 1e24},    {"R", 1e27},  {"Q", 1e30},
};

std::optional<double> find_factor(std::span<const BaseUnit> units, std::string_view text) {
  for (const auto& unit : units) {
    if (text == unit.symbol) return unit.factor;
    // "in.": abbreviations of words, not symbols.
    if (!unit.prefixed && text.ends_with('.') && text.substr(0, text.size() - 1) == unit.symbol) return unit.factor;
  }
  for (const auto& unit : units) {
    if (!unit.prefixed || !text.ends_with(unit.symbol)) continue;
    const auto head = text.substr(0, text.size() - unit.symbol.size());
    for (const auto& [prefix, factor] : prefixes) {
      if (head == prefix) return factor * unit.factor;
    }
  }
  // Words in any case; of symbols it may be the difference between milli and mega.
  constexpr std::size_t shortest_word = 3;
  const std::string lower = lower_case(text);
  for (const auto& unit : units) {
    if (!unit.prefixed && unit.symbol.size() >= shortest_word && lower == unit.symbol) return unit.factor;
  }
  return std::nullopt;
}

// "mm/s", "in/s", "km/h".
std::optional<double> find_velocity(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto length = find_factor(length_units, text.substr(0, slash));
  const auto time = find_factor(time_units, text.substr(slash + 1));
  if (!length || !time) return std::nullopt;
  return *length / *time;
}

// "m/s^2" in its usual spellings, or multiples of standard gravity.
std::optional<double> find_acceleration(std::string_view text) {
  if (const auto gravity = find_factor(gravity_units, text)) return gravity;
  for (const std::string_view tail : {"/s^2", "/s2", "/s\xC2\xB2", "/s\xB2", "/s/s", "/s**2", "/sec^2"}) {
    if (text.ends_with(tail)) return find_factor(length_units, text.substr(0, text.size() - tail.size()));
  }
  return std::nullopt;
}

// "degC", a degree sign in UTF-8 or Latin-1 before the letter, or the letter alone.
std::optional<UnitConversion> find_temperature(std::string_view text) {
  if (text == "K") return UnitConversion{1.0, -273.15};
  std::string_view letter = text;
  for (const std::string_view degree : {"deg", "\xC2\xB0", "\xB0"}) {
    if (text.starts_with(degree)) letter = text.substr(degree.size());
  }
  if (letter == "C" || text == "celsius") return UnitConversion{};
  if (letter == "F" || text == "fahrenheit") return UnitConversion{5.0 / 9.0, -160.0 / 9.0};
  return std::nullopt;
}

std::span<const BaseUnit> units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return time_units;
    case Quantity::displacement:
    case Quantity::base:
      return length_units;
    case Quantity::force:
      return force_units;
    case Quantity::current:
      return current_units;
    case Quantity::voltage:
      return voltage_units;
    case Quantity::velocity:
    case Quantity::acceleration:
    case Quantity::temperature:
      break;
  }
  return {};
}

// Without case and what stands between letters.
std::string folded(std::string_view text) {
  std::string result = lower_case(text);
  std::erase_if(result, [](char c) { return std::string_view(" ./_-^").find(c) != std::string_view::npos; });
  return result;
}

std::optional<UnitConversion> plain(std::optional<double> factor) {
  if (!factor) return std::nullopt;
  return UnitConversion{*factor, 0.0};
}

}  // namespace

std::string_view quantity_name(Quantity quantity) {
  static constexpr std::array<std::string_view, quantity_count> names = {
      "time", "displacement", "velocity", "acceleration", "force", "current", "voltage", "temperature", "base"};
  return names[static_cast<std::size_t>(quantity)];
}

std::string_view accepted_units(Quantity quantity) {
  static constexpr std::array<std::string_view, quantity_count> units = {"s, ms, us, min, h",
                                                                         "m, mm, cm, um, in, ft",
                                                                         "m/s, mm/s, cm/s, in/s, ft/s",
                                                                         "m/s^2, mm/s^2, in/s^2, g",
                                                                         "N, kN, MN, daN, mN, lbf, lb, kip, kgf",
                                                                         "A, mA",
                                                                         "V, mV",
                                                                         "degC, K, degF",
                                                                         "m, mm, cm, um, in, ft"};
  return units[static_cast<std::size_t>(quantity)];
}

std::optional<UnitConversion> find_unit(Quantity quantity, std::string_view text) {
  text = without_blanks(text);
  switch (quantity) {
    case Quantity::time:
      return plain(find_factor(time_units, text));
    case Quantity::displacement:
    case Quantity::base:
      return plain(find_factor(length_units, text));
    case Quantity::velocity:
      return plain(find_velocity(text));
    case Quantity::acceleration:
      return plain(find_acceleration(text));
    case Quantity::force:
      return plain(find_factor(force_units, text));
    case Quantity::current:
      return plain(find_factor(current_units, text));
    case Quantity::voltage:
      return plain(find_factor(voltage_units, text));
    case Quantity::temperature:
      return find_temperature(text);
  }
  return std::nullopt;
}

std::vector<std::string> similar_units(Quantity quantity, std::string_view text) {
  std::vector<std::string> similar;
  const auto take = [&](std::string_view unit) {
    if (folded(unit) == folded(text) && std::ranges::find(similar, unit) == similar.end()) similar.emplace_back(unit);
  };
  for (std::string_view rest = accepted_units(quantity); !rest.empty();) {
    const std::size_t end = std::min(rest.find(", "), rest.size());
    take(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  for (const BaseUnit& unit : units_of(quantity)) take(unit.symbol);
  return similar;
}

bool is_any_unit(std::string_view text) {
  for (int i = 0; i < quantity_count; ++i) {
    if (find_unit(static_cast<Quantity>(i), text)) return true;
  }
  return false;
}

std::optional<UnitConversion> find_pressure(std::string_view text) {
  return plain(find_factor(pressure_units, trimmed(text)));
}

UnitConversion parse_unit(Quantity quantity, std::string_view text, const std::string& file, int line) {
  if (const auto unit = find_unit(quantity, text)) return *unit;
  std::string meant;
  for (const std::string& unit : similar_units(quantity, text)) meant += (meant.empty() ? "" : " or ") + unit;
  const std::string message = "unknown unit " + in_quotes(text) + " of " + std::string(quantity_name(quantity)) +
                              (meant.empty() ? "" : " (did you mean " + meant + "?)") + ", expected one of " +
                              std::string(accepted_units(quantity));
  if (file.empty()) throw InputError(message);
  throw InputError(file, line, message);
}

}  // namespace hysteron
