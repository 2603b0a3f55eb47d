// Kelvin-Voigt: spring and dashpot in parallel.
//   F = c0 v + k0 x + f0
// Source: standard; the linear reference every damper model is compared with.
#include "models/cards.hpp"
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
      {.name = "c0", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 1e3, .linear = true, .role = PhysicalRole::damping},
      cards::k0,
      {.name = "f0", .unit = "N", .meaning = "force at rest at zero displacement", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
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
