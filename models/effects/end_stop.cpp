// Bump stops at both ends of the stroke.
//   F <- F + k_b (d(x - x_up) - d(-x - x_low)),   d(y) = y (y / 1 mm)^(p - 1) for y > 0, 0 otherwise
// k_b is the secant stiffness at a deflection of 1 mm. A stop that the motion does not reach has no influence.
// Source: standard (unilateral spring; p = 1.5 Hertz contact).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct EndStop {
  static constexpr std::string_view id = "end-stop";
  static constexpr std::string_view title = "End stop";
  static constexpr std::string_view reference = "unilateral contact at both ends of the stroke";
  static constexpr std::string_view equations[] = {
      "F <- F + k_b (d_up - d_low)",
      "d_up = max(x - x_up, 0) (max(x - x_up, 0) / 1 mm)^(p - 1), d_low likewise of -x - x_low"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "k_b", .unit = "N/m", .meaning = "secant stiffness of a stop at 1 mm", .box = {0, 3e5}, .initial = 0, .linear = true, .role = PhysicalRole::stiffness, .limits = {.lower = 0}},
      {.name = "x_up", .unit = "m", .meaning = "displacement at which the upper stop touches", .box = {5e-3, 0.04}, .initial = 0.02, .place = 1},
      {.name = "x_low", .unit = "m", .meaning = "distance from zero at which the lower stop touches", .box = {5e-3, 0.04}, .initial = 0.02, .place = -1},
      {.name = "p", .unit = "1", .meaning = "exponent of the stop", .box = {1, 2.5}, .initial = 1.5},
  };
  static constexpr std::string_view kin[] = {"linear-stiffness", "gas-spring", "cubic-stiffness"};
  static constexpr Limit holds[] = {{"cubic-stiffness", "x_up"}};
  // A stop of constant stiffness; one that rises more steeply than is searched is a stop as well.
  static constexpr BoxLimit ends_as[] = {{id, "p", BoxEnd::lower}, {id, "p", BoxEnd::upper}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::stroke_end, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "an end stop",
      .shows = "a steep force near the ends of the stroke and none elsewhere",
      .experiment = "a slow stroke to both ends",
      .rig_cause = "a fixture that touches at the ends of the stroke",
      .acts = Acts::at_ends,
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 4>& card, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [k_b, x_up, x_low, p] = card;
    const T upper = max(in.x - x_up, T(0.0));
    const T lower = max(-in.x - x_low, T(0.0));
    const T power = p - T(1.0);
    return below + k_b * (upper * pow(upper * T(1.0e3), power) - lower * pow(lower * T(1.0e3), power));
  }
};

}  // namespace

extern const Part effect_end_stop;
constexpr Part effect_end_stop = compile<EndStop>();

}  // namespace hysteron
