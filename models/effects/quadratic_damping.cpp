// Pressure drop of turbulent flow through an orifice.
//   F <- F + d2 v |v|
// To first order it is the opposite of shear thinning: the sign of the curvature of force over velocity tells them
// apart.
// Source: standard (Bernoulli).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct QuadraticDamping {
  static constexpr std::string_view id = "quadratic-damping";
  static constexpr std::string_view title = "Quadratic (orifice) damping";
  static constexpr std::string_view reference = "standard turbulent orifice flow";
  static constexpr std::string_view equations[] = {"F <- F + d2 v |v|"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "d2", .unit = "N s^2/m^2", .meaning = "quadratic damping", .box = {0, 2e4}, .initial = 0, .linear = true},
  };
  static constexpr std::string_view kin[] = {"viscous-damping", "shear-thinning"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::speed_bend, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::fluid,
      .in_words = "quadratic (orifice) damping",
      .shows = "the force rises with the square of the speed",
      .experiment = "constant-velocity runs over at least a decade of speed",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [d2] = p;
    return below + d2 * in.v * abs(in.v);
  }
};

}  // namespace

extern const Part effect_quadratic_damping;
constexpr Part effect_quadratic_damping = compile<QuadraticDamping>();

}  // namespace hysteron
