// Hyperbolic tangent law with an open loop.
//   F = alpha tanh(h / v_y) + c0 v + k0 x + f0
//   h' = (v - h) / tau
// Kwok et al. write tanh(beta v + delta sgn(x)) for a sine about x = 0. A recording's absolute position carries no such
// meaning, so the branch is carried by the lagged velocity h instead: for a sine of frequency w both open the loop by
// the same shift of velocity at the reversals when tan(w tau) = delta / (beta v_max). Source: Kwok, Ha, Nguyen, Li,
// Samali, Sens. Actuators A 132 (2006) 441-451, doi 10.1016/j.sna.2006.03.015.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct HyperbolicTangent {
  static constexpr std::string_view id = "hyperbolic-tangent";
  static constexpr std::string_view title = "Hyperbolic tangent of a lagged velocity";
  static constexpr std::string_view reference =
      "after Kwok et al., Sens. Actuators A 132 (2006) 441-451, doi 10.1016/j.sna.2006.03.015";
  static constexpr std::string_view equations[] = {"F = alpha tanh(h / v_y) + c0 v + k0 x + f0", "h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      as_yield_force({"alpha", "alpha", "N", "yield force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}, true}),
      as_damping({"c0", "c0", "N s/m", "viscous damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_stiffness({"k0", "k0", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"v_y", "v_y", "m/s", "yield speed", 1.0e-3, 1.0, 3.0e-2, Scale::logarithmic, {0, 0, 1}},
      {"tau", "tau", "s", "lag that opens the loop", 5.0e-4, 1.0e-1, 5.0e-3, Scale::logarithmic, {0, 1, -1}},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {(in.v - s[0]) * (T(1.0) / p[5])};
  }
  template <class T>
  static T stiffness(const std::array<T, 6>& p, double /*speed*/) {
    return T(1.0) / p[5];
  }
  template <class T>
  static T force(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, v_y, tau] = p;
    return alpha * tanh(s[0] / v_y) + c0 * in.v + k0 * in.x + f0;
  }
};

}  // namespace

extern const Part model_hyperbolic_tangent;
constexpr Part model_hyperbolic_tangent = compile<HyperbolicTangent>();

}  // namespace hysteron
