// The card of a parameter: one line of a part's table, written with designated initialisers. What is not said has its
// default, which for `symbol` is the name and for `dimension` that of the unit:
//   {.name = "c0", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 500, .linear = true,
//    .role = PhysicalRole::damping}
#pragma once

#include <limits>
#include <stdexcept>
#include <string_view>

namespace hysteron {

enum class Scale { linear, logarithmic };

// How a bound grows with the device: bounds are stated for the reference device (1 kN, 25 mm, 0.3 m/s) and multiplied
// by (peak force / 1 kN)^force (half stroke / 25 mm)^length (peak speed / 0.3 m/s)^velocity.
struct Dimension {
  double force = 0.0;
  double length = 0.0;
  double velocity = 0.0;
};

namespace detail {

// A second is a length over a velocity, a kilogram a force over an acceleration. Currents and voltages are not the
// device's.
constexpr Dimension dimension_of_symbol(std::string_view symbol) {
  if (symbol == "N") return {1.0, 0.0, 0.0};
  if (symbol == "m") return {0.0, 1.0, 0.0};
  if (symbol == "s") return {0.0, 1.0, -1.0};
  if (symbol == "kg") return {1.0, 1.0, -2.0};
  if (symbol == "J") return {1.0, 1.0, 0.0};
  if (symbol == "Pa") return {1.0, -2.0, 0.0};
  if (symbol == "A" || symbol == "V" || symbol == "1") return {};
  throw std::invalid_argument("unit of a parameter: expected N, m, s, kg, J, Pa, A, V or 1");
}

}  // namespace detail

// Of a unit written like "N s^2/m^2" or "m/(N s)": all that follows the stroke divides, exponents have one digit. A
// unit that it cannot read does not compile in a card.
constexpr Dimension dimension_of(std::string_view unit) {
  constexpr std::string_view between = " /()^";
  Dimension result;
  double sign = 1.0;
  while (!unit.empty()) {
    if (between.find(unit.front()) != std::string_view::npos) {
      if (unit.front() == '/') sign = -1.0;
      unit.remove_prefix(1);
      continue;
    }
    const std::string_view symbol = unit.substr(0, unit.find_first_of(between));
    unit.remove_prefix(symbol.size());
    const bool raised = unit.size() > 1 && unit.front() == '^';
    const double power = sign * (raised ? unit[1] - '0' : 1);
    if (raised) unit.remove_prefix(2);
    const Dimension own = detail::dimension_of_symbol(symbol);
    result.force += power * own.force;
    result.length += power * own.length;
    result.velocity += power * own.velocity;
  }
  return result;
}

// What a parameter does in its part, where the diagnosis asks for it. A yield force and a damping follow a drive that
// varies; a law with an offset force, a damping, a stiffness or a mass that enters the force linearly has what an
// effect of that one role would add.
enum class PhysicalRole {
  none,          // anything else
  yield_force,   // at which a hysteresis or dry friction yields, never negative
  offset_force,  // constant
  damping,       // of a dashpot, in parallel or in series
  stiffness,     // of a spring, likewise
  mass
};
// "yield force"; empty for none.
constexpr std::string_view name_of(PhysicalRole role) {
  switch (role) {
    case PhysicalRole::yield_force:
      return "yield force";
    case PhysicalRole::offset_force:
      return "offset force";
    case PhysicalRole::damping:
      return "damping";
    case PhysicalRole::stiffness:
      return "stiffness";
    case PhysicalRole::mass:
      return "mass";
    case PhysicalRole::none:
      break;
  }
  return {};
}

// Where a parameter is looked for.
struct Box {
  double lower;
  double upper;
};

// What a parameter can be at all, inside the box or outside.
struct Limits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool zero = true;  // may be zero

  [[nodiscard]] constexpr bool hold(double value) const {
    return value >= lower && value <= upper && (zero || value != 0.0);
  }
};

// What is looked for on one side of zero only is never beyond; what is looked for away from zero divides by it, except
// for coefficients of the force. A spring may push the other way, and a place may be anywhere.
constexpr Limits limits_of(Box box, Scale scale, double place, PhysicalRole role) {
  const bool either_sign = box.lower < 0.0 || place != 0.0 || role == PhysicalRole::offset_force ||
                           (role == PhysicalRole::stiffness && scale == Scale::linear);
  if (either_sign) return {};
  return {.lower = 0.0, .zero = box.lower == 0.0 || role != PhysicalRole::none};
}

// Name, unit, meaning, box and initial value must be said.
struct Parameter {
  std::string_view name;           // in the code, on the command line and in results
  std::string_view symbol = name;  // of the source
  std::string_view unit;           // SI
  std::string_view meaning;
  Box box;
  double initial;
  Scale scale = Scale::linear;               // of the search
  Dimension dimension = dimension_of(unit);  // {} where the bounds hold for every device
  double place = 0.0;   // a place in the stroke: the bounds move with this times the middle of the recorded motion
  bool linear = false;  // the force is affine in it
  bool fixed = false;   // held at `initial` unless the user frees it
  PhysicalRole role = PhysicalRole::none;
  Limits limits = limits_of(box, scale, place, role);
};

}  // namespace hysteron
