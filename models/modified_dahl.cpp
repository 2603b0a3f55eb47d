// Modified Dahl: Dahl's friction hysteresis in parallel with a spring, a dashpot and an offset.
//   F  = c0 v + k0 x + alpha z + f0
//   z' = (v - |v| z) / x_y
// that is z' = sigma v (1 - z sgn(v)) with x_y = 1 / sigma; |z| <= 1.
// Source: Zhou, Qu, Earthquake Eng. Eng. Vib. 22 (2002) 144-150, after Dahl 1968.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ModifiedDahl {
  static constexpr std::string_view id = "modified-dahl";
  static constexpr std::string_view title = "Modified Dahl";
  static constexpr std::string_view reference = "Zhou, Qu, Earthquake Eng. Eng. Vib. 22 (2002) 144-150";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + alpha z + f0", "z' = (v - |v| z) / x_y"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      as_yield_force({"alpha",
                      "F_d",
                      "N",
                      "Coulomb force scaled by the field",
                      0.0,
                      3.0e3,
                      5.0e2,
                      Scale::linear,
                      {1, 0, 0},
                      true}),
      as_damping({"c0", "c0", "N s/m", "viscous damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_stiffness({"k0", "k0", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"x_y", "x_y", "m", "presliding displacement, 1 / sigma", 5.0e-5, 2.5e-2, 1.0e-3, Scale::logarithmic, {0, 1, 0}},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {(in.v - abs(in.v) * s[0]) / p[4]};
  }
  static constexpr int settles = 0;
  template <class T>
  static T stiffness(const std::array<T, 5>& p, double speed) {
    return T(speed) / p[4];
  }
  template <class T>
  static T force(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    return p[1] * in.v + p[2] * in.x + p[0] * s[0] + p[3];
  }
};

}  // namespace

extern const Part model_modified_dahl;
constexpr Part model_modified_dahl = compile<ModifiedDahl>();

}  // namespace hysteron
