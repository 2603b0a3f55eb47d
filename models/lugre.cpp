// LuGre: bristle friction with a Stribeck curve, in parallel with a spring and an offset.
//   F  = alpha z + c1 u + c0 v + k0 x + f0
//   u  = v - |v| z / g,   g = 1 + (ratio - 1) exp(-(v / v_st)^2)
//   z' = u / x_y
// Normal form: with sigma0, sigma1, sigma2, Fc, Fs of the source, alpha = Fc, x_y = Fc / sigma0, ratio = Fs / Fc,
// c1 = sigma1, c0 = sigma2, and z = sigma0 z0 / Fc is dimensionless. At steady velocity F = Fc g(v) sgn(v) + c0 v.
// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419-425,
// doi 10.1109/9.376053.
#include "models/cards.hpp"
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
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .symbol = "F_c", .unit = "N", .meaning = "Coulomb force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c0", .symbol = "sigma_2", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "c1", .symbol = "sigma_1", .unit = "N s/m", .meaning = "damping of the bristles", .box = {0, 2e4}, .initial = 100, .linear = true, .role = PhysicalRole::damping},
      cards::k0,
      cards::f0,
      {.name = "x_y", .unit = "m", .meaning = "bristle deflection at the Coulomb force, F_c / sigma_0", .box = {5e-5, 0.025}, .initial = 1e-3, .scale = Scale::logarithmic},
      {.name = "ratio", .symbol = "F_s/F_c", .unit = "1", .meaning = "ratio of static to Coulomb force", .box = {1, 3}, .initial = 1},
      {.name = "v_st", .symbol = "v_s", .unit = "m/s", .meaning = "Stribeck speed", .box = {1e-3, 0.1}, .initial = 0.01, .scale = Scale::logarithmic},
  };

  template <class T>
  static T bristle_speed(const std::array<T, 8>& p, const T& z, const T& v) {
    const auto& [alpha, c0, c1, k0, f0, x_y, ratio, v_st] = p;
    const T relative = v / v_st;
    const T g = T(1.0) + (ratio - T(1.0)) * exp(-relative * relative);
    return v - abs(v) * z / g;
  }
  template <class T>
  static std::array<T, 1> rate(const std::array<T, 8>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [alpha, c0, c1, k0, f0, x_y, ratio, v_st] = p;
    const auto& [z] = s;
    return {bristle_speed(p, z, in.v) / x_y};
  }
  template <class T>
  static T stiffness(const std::array<T, 8>& p, double speed) {
    const auto& [alpha, c0, c1, k0, f0, x_y, ratio, v_st] = p;
    // Three times the bound: the Stribeck curve changes within a step that is only just stable.
    return T(3.0) * T(speed) / (x_y * min(ratio, T(1.0)));
  }
  template <class T>
  static T force(const std::array<T, 8>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, c1, k0, f0, x_y, ratio, v_st] = p;
    const auto& [z] = s;
    return alpha * z + c1 * bristle_speed(p, z, in.v) + c0 * in.v + k0 * in.x + f0;
  }
};

}  // namespace

extern const Part model_lugre;
constexpr Part model_lugre = compile<LuGre>();

}  // namespace hysteron
