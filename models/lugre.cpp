// LuGre: bristle friction with a Stribeck curve, in parallel with a spring and an offset.
//   F  = alpha z + c1 u + c0 v + k0 x + f0
//   u  = v - |v| z / g,   g = 1 + (ratio - 1) exp(-(v / v_st)^2)
//   z' = u / x_y
// Normal form: with sigma0, sigma1, sigma2, Fc, Fs of the source, alpha = Fc, x_y = Fc / sigma0, ratio = Fs / Fc,
// c1 = sigma1, c0 = sigma2, and z = sigma0 z0 / Fc is dimensionless. At steady velocity F = Fc g(v) sgn(v) + c0 v.
// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419-425,
// doi 10.1109/9.376053.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct LuGre {
  static constexpr std::string_view id = "lugre";
  static constexpr std::string_view title = "LuGre friction";
  static constexpr std::string_view reference =
      "Canudas de Wit et al., IEEE Trans. Autom. Control 40 (1995) 419-425, doi 10.1109/9.376053";
  static constexpr std::string_view equations[] = {
      "F = alpha z + c1 u + c0 v + k0 x + f0", "u = v - |v| z / (1 + (ratio - 1) exp(-(v / v_st)^2))", "z' = u / x_y"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      as_yield_force({"alpha", "F_c", "N", "Coulomb force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}, true}),
      as_damping({"c0", "sigma_2", "N s/m", "viscous damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_damping(
          {"c1", "sigma_1", "N s/m", "damping of the bristles", 0.0, 2.0e4, 1.0e2, Scale::linear, {1, 0, -1}, true}),
      as_stiffness({"k0", "k0", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"x_y",
       "x_y",
       "m",
       "bristle deflection at the Coulomb force, F_c / sigma_0",
       5.0e-5,
       2.5e-2,
       1.0e-3,
       Scale::logarithmic,
       {0, 1, 0}},
      {"ratio", "F_s/F_c", "1", "ratio of static to Coulomb force", 1.0, 3.0, 1.0},
      {"v_st", "v_s", "m/s", "Stribeck speed", 1.0e-3, 1.0e-1, 1.0e-2, Scale::logarithmic, {0, 0, 1}},
  };

  template <class T>
  static T bristle_speed(const std::array<T, 8>& p, const T& z, const T& v) {
    const T relative = v / p[7];
    const T stribeck = T(1.0) + (p[6] - T(1.0)) * exp(-relative * relative);
    return v - abs(v) * z / stribeck;
  }
  template <class T>
  static std::array<T, 1> rate(const std::array<T, 8>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {bristle_speed(p, s[0], in.v) / p[5]};
  }
  template <class T>
  static T stiffness(const std::array<T, 8>& p, double speed) {
    // Three times the bound: the Stribeck curve changes within a step that is only just stable.
    return T(3.0) * T(speed) / (p[5] * min(p[6], T(1.0)));
  }
  template <class T>
  static T force(const std::array<T, 8>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    return p[0] * s[0] + p[2] * bristle_speed(p, s[0], in.v) + p[1] * in.v + p[3] * in.x + p[4];
  }
};

}  // namespace

extern const Part model_lugre;
constexpr Part model_lugre = compile<LuGre>();

}  // namespace hysteron
