// Friction of seal and bearing: Coulomb friction with a Stribeck hump at low speed.
//   F <- F + (fc + fb exp(-(v / v_st)^2)) z tanh(|v| / v_t),   z' = (v - |v| z) / (x_b + |v| t_b)
// z stands for sgn(v), v_t for a film, as in coulomb-friction. fb is the excess of the static over the Coulomb
// friction. Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138,
// doi 10.1016/0005-1098(94)90209-7.
#include "models/bristle.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SealFriction {
  static constexpr std::string_view id = "seal-friction";
  static constexpr std::string_view title = "Seal friction (Coulomb-Stribeck)";
  static constexpr std::string_view reference =
      "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138, doi 10.1016/0005-1098(94)90209-7";
  static constexpr std::string_view equations[] = {"F <- F + (fc + fb exp(-(v / v_st)^2)) z tanh(|v| / v_t)",
                                                   "z' = (v - |v| z) / (x_b + |v| t_b)"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "fc", .symbol = "f_c", .unit = "N", .meaning = "Coulomb friction", .box = {0, 1e3}, .initial = 0, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "fb", .symbol = "f_s - f_c", .unit = "N", .meaning = "excess of static over Coulomb friction", .box = {0, 1e3}, .initial = 0, .linear = true},
      {.name = "v_st", .unit = "m/s", .meaning = "Stribeck speed", .box = {3e-3, 0.1}, .initial = 0.015, .scale = Scale::logarithmic},
      bristle_length,
      film_speed,
  };
  static constexpr std::string_view kin[] = {"coulomb-friction", "pre-yield-hysteresis"};
  static constexpr Limit holds[] = {{"coulomb-friction", "fb"}};
  // A friction that turns over as slowly as it can is a damping that thins out; one that turns at once is the
  // Stribeck curve.
  static constexpr BoxLimit ends_as[] = {{"shear-thinning", "v_t", BoxEnd::upper},
                                         {id, "v_t", BoxEnd::lower},
                                         {id, "x_b", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::dry_friction, Sense::positive}, {ContrastKind::low_speed, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::friction,
      .in_words = "seal friction (Coulomb-Stribeck)",
      .shows = "a force against the motion that is largest at low speed[, the same at any current]",
      .experiment = "a slow triangle[ without current] at several speeds below 20 mm/s",
      .rig_cause = "a guide or bearing between the load cell and the damper",
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [fc, fb, v_st, x_b, v_t] = p;
    const auto& [z] = s;
    return {bristle_rate(x_b, in.v, z)};
  }
  static constexpr int settles = 0;
  template <class T>
  static T towards(const std::array<T, 5>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return in.v;
  }
  template <class T>
  static T stiffness(const std::array<T, 5>& p, double speed) {
    const auto& [fc, fb, v_st, x_b, v_t] = p;
    return bristle_stiffness(x_b, speed);
  }
  template <class T>
  static T force(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in, const T& below) {
    const auto& [fc, fb, v_st, x_b, v_t] = p;
    const auto& [z] = s;
    const T relative = in.v / v_st;
    return below + (fc + fb * exp(-relative * relative)) * z * on_film(v_t, in.v);
  }
};

}  // namespace

extern const Part effect_seal_friction;
constexpr Part effect_seal_friction = compile<SealFriction>();

}  // namespace hysteron
