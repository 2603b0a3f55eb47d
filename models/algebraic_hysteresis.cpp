// Algebraic hysteresis of Kwok et al.: the branch is told by the side of the stroke.
//   F = c0 v + k0 x + alpha z + f0
//   z = tanh((v + v_h sgn(x - x0)) / v_y)
// The source writes z = tanh(beta v + delta sgn(x)): v_y = 1 / beta, v_h = delta / beta. It has no memory. The centre
// x0 of the motion is a parameter, because the zero of a recorded displacement is arbitrary; sgn is tanh((x - x0) /
// x_s), x_s = 0.5 mm. The force is meaningful for motions that swing about x0; hyperbolic-tangent carries the branch by
// a lagged velocity and holds for any motion.
// Source: Kwok, Ha, Nguyen, Li, Samali, Sens. Actuators A 132 (2006)
// 441-451, doi 10.1016/j.sna.2006.03.015.
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
  static constexpr Parameter parameters[] = {
      as_yield_force({"alpha", "alpha", "N", "yield force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}, true}),
      as_damping({"c0", "c", "N s/m", "viscous damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_stiffness({"k0", "k", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"v_y", "1/beta", "m/s", "yield speed", 1.0e-3, 1.0, 3.0e-2, Scale::logarithmic, {0, 0, 1}},
      {"v_h",
       "delta/beta",
       "m/s",
       "half width of the loop: velocity at zero force",
       0.0,
       1.5e-1,
       1.0e-2,
       Scale::linear,
       {0, 0, 1}},
      {"x0", "x0", "m", "centre of the motion", -1.0e-2, 1.0e-2, 0.0, Scale::linear, {0, 1, 0, 1}},
      {"x_s",
       "x_s",
       "m",
       "displacement over which the sign of x - x0 is rounded",
       1.0e-5,
       5.0e-3,
       5.0e-4,
       Scale::logarithmic,
       {0, 1, 0},
       false,
       true},
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
