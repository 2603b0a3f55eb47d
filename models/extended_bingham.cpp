// Extended Bingham: a Bingham element in series with a standard linear solid.
//   F - f0 = G = k2 e = k1 d + c1 d' = fc sgn(u) + c0 u while u != 0,   x = e + d + (slip), u = slip'
//   u  = sgn(G) max(|G| - fc, 0) / c0
//   d' = (k2 e - k1 d) / c1
//   e' = v - d' - u
// The branch |G| <= fc of the source is u = 0. States: deflection e of the series spring, deflection d of the Kelvin
// element; both start at 0.
// Source: Gamota, Filisko, J. Rheol. 35 (1991) 399-425, doi 10.1122/1.550221.
#include "models/cards.hpp"
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
      {.name = "fc", .symbol = "f_c", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .role = PhysicalRole::yield_force},
      {.name = "c0", .unit = "N s/m", .meaning = "post-yield damping", .box = {50, 2e4}, .initial = 500, .scale = Scale::logarithmic, .role = PhysicalRole::damping},
      {.name = "c1", .unit = "N s/m", .meaning = "damping of the Kelvin element", .box = {50, 1e5}, .initial = 2e3, .scale = Scale::logarithmic, .role = PhysicalRole::damping},
      {.name = "k1", .unit = "N/m", .meaning = "stiffness of the Kelvin element", .box = {1e3, 1e6}, .initial = 1e5, .scale = Scale::logarithmic, .role = PhysicalRole::stiffness},
      {.name = "k2", .unit = "N/m", .meaning = "stiffness of the series spring", .box = {1e4, 1e6}, .initial = 3e5, .scale = Scale::logarithmic, .role = PhysicalRole::stiffness},
      cards::f0,
  };

  template <class T>
  static std::array<T, 2> rate(const std::array<T, 6>& p, const std::array<T, 2>& s, const Input<T>& in) {
    const auto& [fc, c0, c1, k1, k2, f0] = p;
    const auto& [e, d] = s;
    const T G = k2 * e;
    const T excess = max(G - fc, T(0.0)) + min(G + fc, T(0.0));  // sgn(G) max(|G| - fc, 0)
    const T d_rate = (G - k1 * d) / c1;
    return {in.v - d_rate - excess / c0, d_rate};
  }
  template <class T>
  static T stiffness(const std::array<T, 6>& p, double /*speed*/) {
    const auto& [fc, c0, c1, k1, k2, f0] = p;
    return k2 / c0 + (k1 + k2) / c1;
  }
  template <class T>
  static T force(const std::array<T, 6>& p, const std::array<T, 2>& s, const Input<T>& /*in*/, const T& /*below*/) {
    const auto& [fc, c0, c1, k1, k2, f0] = p;
    const auto& [e, d] = s;
    return k2 * e + f0;
  }
};

}  // namespace

extern const Part model_extended_bingham;
constexpr Part model_extended_bingham = compile<ExtendedBingham>();

}  // namespace hysteron
