// Units of the files' columns and their conversion to the units used inside: SI, and degC for temperature.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// What a channel measures. The order is that of the channels in every table of src/io.
enum class Quantity { time, displacement, velocity, acceleration, force, current, voltage, temperature, base };
inline constexpr int quantity_count = 9;

// inside = value * factor + offset; only temperatures have an offset.
struct UnitConversion {
  double factor = 1.0;
  double offset = 0.0;

  [[nodiscard]] double to_si(double value) const { return value * factor + offset; }
  [[nodiscard]] double from_si(double value) const { return (value - offset) / factor; }
  bool operator==(const UnitConversion&) const = default;
};

// "time", "displacement", ...: the name of the quantity in messages and in --column.
[[nodiscard]] std::string_view quantity_name(Quantity quantity);

// The units accepted for a quantity, as shown in error messages.
[[nodiscard]] std::string_view accepted_units(Quantity quantity);

// The conversion of `text` (case matters: mN is not MN), or nothing when it is not a unit of the quantity.
[[nodiscard]] std::optional<UnitConversion> find_unit(Quantity quantity, std::string_view text);

// Units of the quantity that the text is but for case and what stands between letters: kN of "KN", m/s of "ms". They
// may differ by nine orders of magnitude, MN and mN of "mn", and are offered, not taken.
[[nodiscard]] std::vector<std::string> similar_units(Quantity quantity, std::string_view text);

// Whether the text is a unit of any quantity.
[[nodiscard]] bool is_any_unit(std::string_view text);

// To Pa, of a unit of pressure: Pa and bar with SI prefixes, psi, ksi, atm.
[[nodiscard]] std::optional<UnitConversion> find_pressure(std::string_view text);

// As find_unit; an unknown unit is an InputError at file:line that names it, similar ones and the accepted ones.
[[nodiscard]] UnitConversion parse_unit(Quantity quantity, std::string_view text, const std::string& file = {},
                                        int line = 0);

}  // namespace hysteron
