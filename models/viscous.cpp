// Kelvin-Voigt: spring and dashpot in parallel.
//   F = c0 v + k0 x + f0
// Source: standard; the linear reference every damper model is compared with.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Viscous {
  static constexpr std::string_view id = "viscous";
  static constexpr std::string_view title = "Kelvin-Voigt: spring and dashpot";
  static constexpr std::string_view reference = "Standard linear model (Kelvin-Voigt)";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + f0"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      as_damping({"c0", "c0", "N s/m", "viscous damping", 0.0, 2.0e4, 1.0e3, Scale::linear, {1, 0, -1}, true}),
      as_stiffness({"k0", "k0", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true}),
      as_offset_force({"f0",
                       "f0",
                       "N",
                       "force at rest in the middle of the motion",
                       -1.5e3,
                       1.5e3,
                       0.0,
                       Scale::linear,
                       {1, 0, 0},
                       true}),
  };

  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [c0, k0, f0] = p;
    return c0 * in.v + k0 * in.x + f0;
  }
};

}  // namespace

extern const Part model_viscous;
constexpr Part model_viscous = compile<Viscous>();

}  // namespace hysteron
