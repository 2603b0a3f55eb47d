// Extended Bingham: a Bingham element in series with a standard linear solid.
//   F - f0 = G = k2 e = k1 d + c1 d' = fc sgn(u) + c0 u while u != 0,   x = e + d + (slip), u = slip'
//   u  = sgn(G) max(|G| - fc, 0) / c0
//   d' = (k2 e - k1 d) / c1
//   e' = v - d' - u
// The branch |G| <= fc of the source is u = 0. States: deflection e of the series spring, deflection d of the Kelvin
// element; both start at 0.
// Source: Gamota, Filisko, J. Rheol. 35 (1991) 399-425, doi 10.1122/1.550221.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ExtendedBingham {
  static constexpr std::string_view id = "extended-bingham";
  static constexpr std::string_view title = "Extended Bingham (Gamota-Filisko)";
  static constexpr std::string_view reference = "Gamota, Filisko, J. Rheol. 35 (1991) 399-425, doi 10.1122/1.550221";
  static constexpr std::string_view equations[] = {"F = k2 e + f0", "e' = v - d' - sgn(e) max(k2 |e| - fc, 0) / c0",
                                                   "d' = (k2 e - k1 d) / c1"};
  static constexpr int states = 2;
  static constexpr Parameter parameters[] = {
      as_yield_force({"fc", "f_c", "N", "yield force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}}),
      as_damping({"c0", "c0", "N s/m", "post-yield damping", 5.0e1, 2.0e4, 5.0e2, Scale::logarithmic, {1, 0, -1}}),
      as_damping(
          {"c1", "c1", "N s/m", "damping of the Kelvin element", 5.0e1, 1.0e5, 2.0e3, Scale::logarithmic, {1, 0, -1}}),
      as_stiffness(
          {"k1", "k1", "N/m", "stiffness of the Kelvin element", 1.0e3, 1.0e6, 1.0e5, Scale::logarithmic, {1, -1, 0}}),
      as_stiffness(
          {"k2", "k2", "N/m", "stiffness of the series spring", 1.0e4, 1.0e6, 3.0e5, Scale::logarithmic, {1, -1, 0}}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
  };

  template <class T>
  static std::array<T, 2> rate(const std::array<T, 6>& p, const std::array<T, 2>& s, const Input<T>& in) {
    const auto& [fc, c0, c1, k1, k2, f0] = p;
    const T carried = k2 * s[0];
    const T excess = max(carried - fc, T(0.0)) + min(carried + fc, T(0.0));
    const T kelvin = (carried - k1 * s[1]) / c1;
    return {in.v - kelvin - excess / c0, kelvin};
  }
  template <class T>
  static T stiffness(const std::array<T, 6>& p, double /*speed*/) {
    const auto& [fc, c0, c1, k1, k2, f0] = p;
    return k2 / c0 + (k1 + k2) / c1;
  }
  template <class T>
  static T force(const std::array<T, 6>& p, const std::array<T, 2>& s, const Input<T>& /*in*/, const T& /*below*/) {
    return p[4] * s[0] + p[5];
  }
};

}  // namespace

extern const Part model_extended_bingham;
constexpr Part model_extended_bingham = compile<ExtendedBingham>();

}  // namespace hysteron
