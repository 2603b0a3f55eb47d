// Shear thinning: a part c_t of the viscous damping disappears above the speed v_c.
//   c(v) = c0 - c_t (1 - (1 + (v / v_c)^2)^((m - 1) / 2)),   F <- F + (c(v) - c0) v
// With c_t = c0 this is the Carreau law of flow index m, a power law far above v_c (Herschel-Bulkley with a yield
// force).
// Source: Carreau, Trans. Soc. Rheol. 16 (1972) 99-127, doi 10.1122/1.549276.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ShearThinning {
  static constexpr std::string_view id = "shear-thinning";
  static constexpr std::string_view title = "Shear thinning";
  static constexpr std::string_view reference = "Carreau, Trans. Soc. Rheol. 16 (1972) 99-127, doi 10.1122/1.549276";
  static constexpr std::string_view equations[] = {"F <- F - c_t v (1 - (1 + (v / v_c)^2)^((m - 1) / 2))"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "c_t", .unit = "N s/m", .meaning = "damping that thins out", .box = {0, 2e4}, .initial = 0, .linear = true, .role = PhysicalRole::damping},
      {.name = "v_c", .unit = "m/s", .meaning = "speed at which thinning sets in", .box = {5e-3, 1}, .initial = 0.05, .scale = Scale::logarithmic},
      {.name = "m", .unit = "1", .meaning = "flow index: 1 is Newtonian", .box = {0, 0.9}, .initial = 0.5},
  };
  static constexpr std::string_view kin[] = {"viscous-damping", "quadratic-damping", "coulomb-friction"};
  static constexpr Limit holds[] = {{"coulomb-friction", "m"}};
  // Damping that thins out entirely is a friction.
  static constexpr BoxLimit ends_as[] = {{"coulomb-friction", "m", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::speed_bend, Sense::negative}};
  static constexpr Knowledge knowledge = {
      .family = families::fluid,
      .in_words = "shear thinning",
      .shows = "the force rises less and less with the speed",
      .experiment = "constant-velocity runs over at least a decade of speed",
      .rig_cause = "a force channel at its limit",
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [c_t, v_c, m] = p;
    const T relative = in.v / v_c;
    const T left = pow(T(1.0) + relative * relative, T(0.5) * (m - T(1.0)));
    return below - c_t * in.v * (T(1.0) - left);
  }
};

}  // namespace

extern const Part effect_shear_thinning;
constexpr Part effect_shear_thinning = compile<ShearThinning>();

}  // namespace hysteron
