// Dry friction of constant size in parallel.
//   F <- F + fc z tanh(|v| / v_t),   z' = (v - |v| z) / (x_b + |v| t_b),   t_b = 0.5 ms
// z stands for sgn(v): the contact bends over x_b before it slides, as contacts do, and a noisy velocity about rest
// does not make the force jump. At speed the turn takes t_b. A film of lubricant carries a part of it below v_t.
// Source: Dahl, Aerospace Corp. report TOR-0158(3107-18)-1, 1968.
#include "models/bristle.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct CoulombFriction {
  static constexpr std::string_view id = "coulomb-friction";
  static constexpr std::string_view title = "Coulomb friction";
  static constexpr std::string_view reference = "standard dry friction";
  static constexpr std::string_view equations[] = {"F <- F + fc z tanh(|v| / v_t)",
                                                   "z' = (v - |v| z) / (x_b + |v| t_b)"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "fc", .symbol = "f_c", .unit = "N", .meaning = "friction force", .box = {0, 1e3}, .initial = 0, .linear = true, .role = PhysicalRole::yield_force},
      bristle_length,
      film_speed,
  };
  static constexpr std::string_view kin[] = {"seal-friction", "pre-yield-hysteresis", "shear-thinning"};
  // A friction that turns over as slowly as it can is a damping that thins out; one that turns at once is Coulomb's law.
  static constexpr BoxLimit ends_as[] = {{"shear-thinning", "v_t", BoxEnd::upper},
                                         {id, "v_t", BoxEnd::lower},
                                         {id, "x_b", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::dry_friction, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::friction,
      .in_words = "Coulomb friction",
      .shows = "a force of one size against the motion, at the slowest speed too",
      .experiment = "a slow triangle[ without current] at several speeds below 20 mm/s",
      .rig_cause = "a guide or bearing between the load cell and the damper",
      .kin = kin,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 3>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [fc, x_b, v_t] = p;
    const auto& [z] = s;
    return {bristle_rate(x_b, in.v, z)};
  }
  static constexpr int settles = 0;
  template <class T>
  static T towards(const std::array<T, 3>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return in.v;
  }
  template <class T>
  static T stiffness(const std::array<T, 3>& p, double speed) {
    const auto& [fc, x_b, v_t] = p;
    return bristle_stiffness(x_b, speed);
  }
  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 1>& s, const Input<T>& in, const T& below) {
    const auto& [fc, x_b, v_t] = p;
    const auto& [z] = s;
    return below + fc * z * on_film(v_t, in.v);
  }
};

}  // namespace

extern const Part effect_coulomb_friction;
constexpr Part effect_coulomb_friction = compile<CoulombFriction>();

}  // namespace hysteron
