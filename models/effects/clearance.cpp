// Play between damper and machine: pins, rod ends. The damper rests while the gap is crossed.
//   F = F_law(x - d, v - d') = q + tau q',   d = C_c q + (gap / 2) tanh(q / f_c)
// q is the contact force: below f_c = 1 % of the peak force of the device the contact is open, above it bears with the
// compliance C_c = 1 / k_c. tau = 0.5 ms damps the contact. gap is the full width of the play, in whose
// middle the recording starts.
// Source: standard (backlash with contact stiffness), with the dead zone rounded at f_c.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Clearance {
  static constexpr std::string_view id = "clearance";
  static constexpr std::string_view title = "Clearance (play with contact stiffness)";
  static constexpr std::string_view reference = "standard (backlash with contact stiffness)";
  static constexpr std::string_view equations[] = {"F = F_law(x - d, v - d') = q + tau q'",
                                                   "d = C_c q + (gap / 2) tanh(q / f_c)"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "gap", .symbol = "g", .unit = "m", .meaning = "full width of the play", .box = {0, 5e-3}, .initial = 0},
      {.name = "C_c", .symbol = "1/k_c", .unit = "m/N", .meaning = "compliance of the closed contact", .box = {0, 1e-6}, .initial = 0},
      {.name = "f_c", .unit = "N", .meaning = "force at which the contact bears", .box = {2, 100}, .initial = 10, .scale = Scale::logarithmic, .fixed = true},
      {.name = "tau", .unit = "s", .meaning = "relaxation time of the contact damping", .box = {2e-4, 5e-3}, .initial = 5e-4, .scale = Scale::logarithmic, .fixed = true},
  };
  static constexpr std::string_view kin[] = {"compliance", "entrapped-gas"};
  static constexpr Limit holds[] = {{"compliance", "gap"}};
  // A play with a rigid contact.
  static constexpr BoxLimit ends_as[] = {{id, "C_c", BoxEnd::lower}};
  static constexpr KindredParameter kindred[] = {{"gap", "entrapped-gas", "d_a", 0.5},
                                                 {"C_c", "entrapped-gas", "C_c", 1.0}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::reversal_travel, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::free_travel,
      .in_words = "clearance (play with a stiffness of contact)",
      .shows = "the rod travels without force after each reversal, equally far at any speed[ and current]",
      .experiment =
          "two strokes at the same speed, one about as small as the suspected gap[, at two currents]: a gap keeps its "
          "width in mm, a compliance grows with the force",
      .rig_cause = "a loose pin or joint between the displacement sensor and the damper",
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .kindred = kindred,
      .contrasts = contrasts,
  };

  template <class T>
  static Yield<T> yield(const std::array<T, 4>& p, const T& q) {
    const auto& [gap, C_c, f_c, tau] = p;
    const T half = T(0.5) * gap;
    const T inverse = T(1.0) / f_c;
    const T bearing = tanh(q * inverse);
    const T open = half * inverse * (T(1.0) - bearing * bearing);
    return {q * C_c + half * bearing, C_c + open, T(-2.0) * open * bearing * inverse, T(1.0) / tau, T(1.0), f_c};
  }
};

}  // namespace

extern const Part effect_clearance;
constexpr Part effect_clearance = compile<Clearance>();

}  // namespace hysteron
