// Algebraic hysteresis of Kwok et al.: the branch is told by the side of the stroke.
//   F = c0 v + k0 x + alpha z + f0
//   z = tanh((v + v_h sgn(x - x0)) / v_y)
// The source writes z = tanh(beta v + delta sgn(x)): v_y = 1 / beta, v_h = delta / beta. It has no memory. The centre
// x0 of the motion is a parameter, because the zero of a recorded displacement is arbitrary; sgn is tanh((x - x0) /
// x_s), x_s = 0.5 mm. The force is meaningful for motions that swing about x0; hyperbolic-tangent carries the branch by
// a lagged velocity and holds for any motion.
// Source: Kwok, Ha, Nguyen, Li, Samali, Sens. Actuators A 132 (2006)
// 441-451, doi 10.1016/j.sna.2006.03.015.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct AlgebraicHysteresis {
  static constexpr std::string_view id = "algebraic-hysteresis";
  static constexpr std::string_view title = "Algebraic hysteresis (Kwok)";
  static constexpr std::string_view reference =
      "Kwok et al., Sens. Actuators A 132 (2006) 441-451, doi 10.1016/j.sna.2006.03.015";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + alpha z + f0",
                                                   "z = tanh((v + v_h tanh((x - x0) / x_s)) / v_y)"};
  static constexpr int states = 0;
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c0", .symbol = "c", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "k0", .symbol = "k", .unit = "N/m", .meaning = "stiffness", .box = {-2e4, 1e5}, .initial = 0, .linear = true, .role = PhysicalRole::stiffness},
      cards::f0,
      {.name = "v_y", .symbol = "1/beta", .unit = "m/s", .meaning = "yield speed", .box = {1e-3, 1}, .initial = 0.03, .scale = Scale::logarithmic},
      {.name = "v_h", .symbol = "delta/beta", .unit = "m/s", .meaning = "half width of the loop: velocity at zero force", .box = {0, 0.15}, .initial = 0.01},
      {.name = "x0", .unit = "m", .meaning = "centre of the motion", .box = {-0.01, 0.01}, .initial = 0, .place = 1},
      {.name = "x_s", .unit = "m", .meaning = "displacement over which the sign of x - x0 is rounded", .box = {1e-5, 5e-3}, .initial = 5e-4, .scale = Scale::logarithmic, .fixed = true},
  };

  template <class T>
  static T force(const std::array<T, 8>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, v_y, v_h, x0, x_s] = p;
    const T side = tanh((in.x - x0) / x_s);
    return c0 * in.v + k0 * in.x + alpha * tanh((in.v + v_h * side) / v_y) + f0;
  }
};

}  // namespace

extern const Part model_algebraic_hysteresis;
constexpr Part model_algebraic_hysteresis = compile<AlgebraicHysteresis>();

}  // namespace hysteron
