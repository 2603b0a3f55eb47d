// Modified Dahl: Dahl's friction hysteresis in parallel with a spring, a dashpot and an offset.
//   F  = c0 v + k0 x + alpha z + f0
//   z' = (v - |v| z) / x_y
// that is z' = sigma v (1 - z sgn(v)) with x_y = 1 / sigma; |z| <= 1.
// Source: Zhou, Qu, Earthquake Eng. Eng. Vib. 22 (2002) 144-150, after Dahl 1968.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ModifiedDahl {
  static constexpr std::string_view id = "modified-dahl";
  static constexpr std::string_view title = "Modified Dahl";
  static constexpr std::string_view reference = "Zhou, Qu, Earthquake Eng. Eng. Vib. 22 (2002) 144-150";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + alpha z + f0", "z' = (v - |v| z) / x_y"};
  static constexpr int states = 1;
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .symbol = "F_d", .unit = "N", .meaning = "Coulomb force scaled by the field", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      cards::c0,
      cards::k0,
      cards::f0,
      {.name = "x_y", .unit = "m", .meaning = "presliding displacement, 1 / sigma", .box = {5e-5, 0.025}, .initial = 1e-3, .scale = Scale::logarithmic},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [alpha, c0, k0, f0, x_y] = p;
    const auto& [z] = s;
    return {(in.v - abs(in.v) * z) / x_y};
  }
  static constexpr int settles = 0;
  template <class T>
  static T towards(const std::array<T, 5>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return in.v;
  }
  template <class T>
  static T stiffness(const std::array<T, 5>& p, double speed) {
    const auto& [alpha, c0, k0, f0, x_y] = p;
    return T(speed) / x_y;
  }
  template <class T>
  static T force(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, x_y] = p;
    const auto& [z] = s;
    return c0 * in.v + k0 * in.x + alpha * z + f0;
  }
};

}  // namespace

extern const Part model_modified_dahl;
constexpr Part model_modified_dahl = compile<ModifiedDahl>();

}  // namespace hysteron
