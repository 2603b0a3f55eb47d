// Guo-Hu: accumulator preload, dashpot and an arc tangent of the velocity shifted by the branch.
//   F = f0 + c0 v + (2 / pi) f_y atan((v - v_h b) / v_y),   b = tanh(a / a_s), the sign of the acceleration
// The source writes atan(K (v - v_0 sgn(a))) + m a: v_y = 1 / K, v_h = v_0. Its mass term is the effect inertia, so that
// guo-hu+inertia is the whole of it.
// The acceleration is that of models/motion_filter.hpp with tau = 2 ms; a_s = 0.2 m/s^2 rounds its sign.
// Source: Guo, Hu, Yi, J. Vib. Control 10 (2004) 461-471, doi 10.1177/1077546304038968.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

// Halves the angle three times, so that the argument of the series is below tan(pi / 16); error below 1e-16.
template <class T>
T arc_tangent(const T& a) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    T x = a;
    for (int i = 0; i < 3; ++i) {
      x = x / (T(1.0) + sqrt(T(1.0) + x * x));
    }
    const T q = x * x;
    T p = T(1.0 / 21.0);
    for (const double odd : {19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) {
      p = T(1.0 / odd) - p * q;
    }
    return T(8.0) * x * p;
  } else {
    using S = value_t<T>;
    return chain(a, arc_tangent(a.v), S(1.0) / (S(1.0) + a.v * a.v));
  }
}

struct GuoHu {
  static constexpr std::string_view id = "guo-hu";
  static constexpr std::string_view title = "Guo-Hu: arc tangent of the shifted velocity";
  static constexpr std::string_view reference =
      "Guo, Hu, Yi, J. Vib. Control 10 (2004) 461-471, doi 10.1177/1077546304038968";
  static constexpr std::string_view equations[] = {"F = f0 + c0 v + (2 / pi) f_y atan((v - v_h b) / v_y)",
                                                   "b = tanh(a / a_s)", "a from h' = (v - h) / tau",
                                                   "the source's m a is the effect inertia: guo-hu+inertia"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "f_y", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c0", .symbol = "c_b", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "f0", .unit = "N", .meaning = "preload of the accumulator", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
      {.name = "v_y", .symbol = "1/K", .unit = "m/s", .meaning = "yield speed", .box = {1e-3, 1}, .initial = 0.02, .scale = Scale::logarithmic},
      {.name = "v_h", .symbol = "v_0", .unit = "m/s", .meaning = "half width of the loop: velocity at zero force", .box = {0, 0.15}, .initial = 0.01},
      acceleration_lag,
      acceleration_rounding,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [f_y, c0, f0, v_y, v_h, tau, a_s] = p;
    const auto& [h] = s;
    return {(in.v - h) / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 7>& p, double /*speed*/) {
    const auto& [f_y, c0, f0, v_y, v_h, tau, a_s] = p;
    // Four times the bound: the acceleration is the lagged velocity's error over tau.
    return T(4.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [f_y, c0, f0, v_y, v_h, tau, a_s] = p;
    const auto& [h] = s;
    const T b = tanh(acceleration(in.v, h, tau, in.age) / a_s);
    constexpr double two_over_pi = 0.63661977236758134308;
    return f0 + c0 * in.v + T(two_over_pi) * f_y * arc_tangent((in.v - v_h * b) / v_y);
  }
};

}  // namespace

extern const Part model_guo_hu;
constexpr Part model_guo_hu = compile<GuoHu>();

}  // namespace hysteron
