// A second hysteresis with its own yield displacement in parallel, as of seals or particle chains that deform before
// they yield.
//   F <- F + f_h z,   z' = (v - |v| z) / x_y
// What yields within 4 % of the stroke is dry friction (coulomb-friction, seal-friction) rather than this.
// Source: Dahl, Aerospace Corp. report TOR-0158(3107-18)-1, 1968.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct PreYieldHysteresis {
  static constexpr std::string_view id = "pre-yield-hysteresis";
  static constexpr std::string_view title = "Pre-yield hysteresis (parallel Dahl element)";
  static constexpr std::string_view reference = "Dahl, Aerospace Corp. TOR-0158(3107-18)-1, 1968";
  static constexpr std::string_view equations[] = {"F <- F + f_h z", "z' = (v - |v| z) / x_y"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "f_h", .unit = "N", .meaning = "force of the saturated element", .box = {0, 2e3}, .initial = 0, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "x_y", .unit = "m", .meaning = "its yield displacement", .box = {1e-3, 0.025}, .initial = 5e-3, .scale = Scale::logarithmic},
  };
  static constexpr std::string_view kin[] = {"coulomb-friction", "seal-friction"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::pre_yield, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::friction,
      .in_words = "pre-yield hysteresis (a Dahl element in parallel)",
      .shows = "strokes below the yield displacement draw loops of their own, the same at any speed",
      .experiment = "small strokes at several amplitudes below the knee",
      .rig_cause = "a rubber mount between the displacement sensor and the damper",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [f_h, x_y] = p;
    const auto& [z] = s;
    return {(in.v - abs(in.v) * z) / x_y};
  }
  static constexpr int settles = 0;
  template <class T>
  static T towards(const std::array<T, 2>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return in.v;
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& p, double speed) {
    const auto& [f_h, x_y] = p;
    return T(speed) / x_y;
  }
  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    const auto& [f_h, x_y] = p;
    const auto& [z] = s;
    return below + f_h * z;
  }
};

}  // namespace

extern const Part effect_pre_yield_hysteresis;
constexpr Part effect_pre_yield_hysteresis = compile<PreYieldHysteresis>();

}  // namespace hysteron
