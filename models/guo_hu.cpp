// Guo-Hu: accumulator preload, dashpot and an arc tangent of the velocity shifted by the branch.
//   F = f0 + c0 v + (2 / pi) f_y atan((v - v_h b) / v_y),   b = tanh(a / a_s), the sign of the acceleration
// The source writes atan(K (v - v_0 sgn(a))): v_y = 1 / K, v_h = v_0.
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
                                                   "b = tanh(a / a_s)", "a from h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      as_yield_force({"f_y", "f_y", "N", "yield force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}, true}),
      as_damping({"c0", "c_b", "N s/m", "viscous damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_offset_force(
          {"f0", "f0", "N", "preload of the accumulator", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"v_y", "1/K", "m/s", "yield speed", 1.0e-3, 1.0, 2.0e-2, Scale::logarithmic, {0, 0, 1}},
      {"v_h",
       "v_0",
       "m/s",
       "half width of the loop: velocity at zero force",
       0.0,
       1.5e-1,
       1.0e-2,
       Scale::linear,
       {0, 0, 1}},
      {"tau",
       "tau",
       "s",
       "time constant of the acceleration estimate",
       5.0e-4,
       2.0e-2,
       2.0e-3,
       Scale::logarithmic,
       {0, 1, -1},
       false,
       true},
      {"a_s",
       "a_s",
       "m/s^2",
       "acceleration at which its sign is rounded",
       1.0e-2,
       5.0,
       2.0e-1,
       Scale::logarithmic,
       {0, -1, 2},
       false,
       true},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in) {
    return {(in.v - s[0]) / p[5]};
  }
  template <class T>
  static T stiffness(const std::array<T, 7>& p, double /*speed*/) {
    // Four times the bound: the acceleration is the lagged velocity's error over tau.
    return T(4.0) / p[5];
  }
  template <class T>
  static T force(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [f_y, c0, f0, v_y, v_h, tau, a_s] = p;
    const T branch = tanh(acceleration(in.v, s[0], tau, in.age) / a_s);
    constexpr double two_over_pi = 0.63661977236758134308;
    return f0 + c0 * in.v + T(two_over_pi) * f_y * arc_tangent((in.v - v_h * branch) / v_y);
  }
};

}  // namespace

extern const Part model_guo_hu;
constexpr Part model_guo_hu = compile<GuoHu>();

}  // namespace hysteron
