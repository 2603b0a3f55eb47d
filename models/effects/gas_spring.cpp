// Gas charge of the accumulator acting on the rod's cross-section A.
//   F <- F + f_g (1 - g x)^(-kappa),   f_g = p0 A, g = A / V0
// p0 and V0 are pressure and gas volume at x = 0. Stiffness at x = 0: kappa f_g g. Both f_g and g are negative where
// positive displacement extends the damper. kappa is 1 for slow, 1.4 for fast strokes, more under high pressure; small
// strokes tell only its product with g. 1 - g x is kept above 0.05, which the box of g reaches at the end of the
// stroke. Source: polytropic gas law.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct GasSpring {
  static constexpr std::string_view id = "gas-spring";
  static constexpr std::string_view title = "Gas spring of the accumulator";
  static constexpr std::string_view reference = "polytropic gas law";
  static constexpr std::string_view equations[] = {"F <- F + f_g (1 - g x)^(-kappa)"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "f_g", .unit = "N", .meaning = "gas force at x = 0", .box = {-1e3, 1e3}, .initial = 0, .linear = true},
      {.name = "g", .symbol = "A/V0", .unit = "1/m", .meaning = "swept fraction of the gas volume per length", .box = {-38, 38}, .initial = 4},
      {.name = "kappa", .unit = "1", .meaning = "polytropic exponent", .box = {1, 1.67}, .initial = 1.2},
  };
  static constexpr std::string_view kin[] = {"offset-force", "linear-stiffness", "cubic-stiffness", "end-stop"};
  // Isothermal, and adiabatic for a monatomic gas.
  static constexpr BoxLimit ends_as[] = {{id, "kappa", BoxEnd::lower}, {id, "kappa", BoxEnd::upper}};
  // A large gas force with hardly any gas swept is a spring.
  static constexpr Limit holds[] = {{"offset-force", "g"}, {"linear-stiffness", ""}};
  // Gas pushes back harder the further it is compressed.
  static constexpr SameSign same_sign[] = {{"f_g", "g"}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::mean_force, Sense::either}, {ContrastKind::stiffness, Sense::positive}, {ContrastKind::stiffness_bend, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "the gas spring of the accumulator",
      .shows = "a force of the position alone that stiffens as the gas is compressed",
      .experiment = "a slow full stroke around two mid-positions",
      .rig_cause = "a spring or flexure beside the damper",
      .acts = Acts::by_place,
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .same_sign = same_sign,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [f_g, g, kappa] = p;
    return below + f_g * pow(max(T(1.0) - g * in.x, T(0.05)), -kappa);
  }
};

}  // namespace

extern const Part effect_gas_spring;
constexpr Part effect_gas_spring = compile<GasSpring>();

}  // namespace hysteron
