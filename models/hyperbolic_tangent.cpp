// Hyperbolic tangent law with an open loop.
//   F = alpha tanh(h / v_y) + c0 v + k0 x + f0
//   h' = (v - h) / tau
// Kwok et al. write tanh(beta v + delta sgn(x)) for a sine about x = 0. A recording's absolute position carries no such
// meaning, so the branch is carried by the lagged velocity h instead: for a sine of frequency w both open the loop by
// the same shift of velocity at the reversals when tan(w tau) = delta / (beta v_max). Source: Kwok, Ha, Nguyen, Li,
// Samali, Sens. Actuators A 132 (2006) 441-451, doi 10.1016/j.sna.2006.03.015.
#include "models/cards.hpp"
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
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      cards::c0,
      cards::k0,
      cards::f0,
      {.name = "v_y", .unit = "m/s", .meaning = "yield speed", .box = {1e-3, 1}, .initial = 0.03, .scale = Scale::logarithmic},
      {.name = "tau", .unit = "s", .meaning = "lag that opens the loop", .box = {5e-4, 0.1}, .initial = 5e-3, .scale = Scale::logarithmic},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [alpha, c0, k0, f0, v_y, tau] = p;
    const auto& [h] = s;
    return {(in.v - h) * (T(1.0) / tau)};
  }
  template <class T>
  static T stiffness(const std::array<T, 6>& p, double /*speed*/) {
    const auto& [alpha, c0, k0, f0, v_y, tau] = p;
    return T(1.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, v_y, tau] = p;
    const auto& [h] = s;
    return alpha * tanh(h / v_y) + c0 * in.v + k0 * in.x + f0;
  }
};

}  // namespace

extern const Part model_hyperbolic_tangent;
constexpr Part model_hyperbolic_tangent = compile<HyperbolicTangent>();

}  // namespace hysteron
