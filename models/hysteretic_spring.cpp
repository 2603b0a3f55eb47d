// Hysteretic spring: Bouc-Wen hysteresis of exponent 1 that may stiffen while it loads, beside a spring and a dashpot.
//   F  = c0 v + k0 x + k_z q + f0
//   q' = v - 1/2 (on + off) |v| q - 1/2 (on - off) v |q|
// k_z q is the hysteretic force; per travel its slope is k_z (1 - on |q|) while it grows and k_z (1 + off |q|) while it
// goes back. With the parameters of
//   z' = alpha v - beta (gamma |v| z + delta v |z|),   F = ... + z:
//   k_z = alpha, on = beta (gamma + delta), off = beta (gamma - delta), z = k_z q.
// bouc-wen with n = 1 is on = 1 / x_y, off = (2 share - 1) / x_y, k_z = alpha / x_y; it cannot have on <= 0, the spring
// that stiffens.
//
// Why the box keeps the force finite. The travel that loads the hysteresis from 0 to |q| is
//   phi = -ln(1 - on |q|) / on,
// finite for every travel where on < 0, then exponential: |q| = (exp(-on phi) - 1) / -on. Loading adds its travel to
// phi; unloading takes off its travel times (1 + off |q|) / (1 - on |q|), no less than the travel where off >= -on. So
// phi never exceeds the stroke S, also over small loops, and on >= -50 / m with S = 50 mm of the reference device
// bounds |q| by 0.22 m. Hence the lower bound of `off` is that of -on.
// Source: Noel, Schoukens, Hysteretic benchmark with a dynamic nonlinearity, Workshop on Nonlinear System
// Identification Benchmarks, Brussels 2016, doi 10.4121/12967592; Wen, J. Eng. Mech. Div. 102 (1976) 249-263.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct HystereticSpring {
  static constexpr std::string_view id = "hysteretic-spring";
  static constexpr std::string_view title = "Hysteretic spring: Bouc-Wen of exponent 1 that may stiffen";
  static constexpr std::string_view reference =
      "Noel, Schoukens, Hysteretic benchmark with a dynamic nonlinearity, 2016, doi 10.4121/12967592; Wen, J. Eng. "
      "Mech. Div. 102 (1976) 249-263, doi 10.1061/JMCEA3.0002106";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + k_z q + f0",
                                                   "q' = v - (on + off) / 2 |v| q - (on - off) / 2 v |q|"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "k_z", .symbol = "alpha", .unit = "N/m", .meaning = "stiffness of the hysteresis where its force is zero", .box = {0, 1e5}, .initial = 1e4, .linear = true},
      cards::c0,
      cards::k0,
      cards::f0,
      {.name = "on", .symbol = "beta (gamma + delta)", .unit = "1/m", .meaning = "softening of the hysteresis while it loads, negative: it stiffens", .box = {-50, 400}, .initial = 20},
      {.name = "off", .symbol = "beta (gamma - delta)", .unit = "1/m", .meaning = "stiffening of the hysteresis while it unloads", .box = {50, 4000}, .initial = 200, .scale = Scale::logarithmic},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [k_z, c0, k0, f0, on, off] = p;
    const auto& [q] = s;
    return {in.v - T(0.5) * ((on + off) * abs(in.v) * q + (on - off) * in.v * abs(q))};
  }
  template <class T>
  static T stiffness(const std::array<T, 6>& p, double speed) {
    const auto& [k_z, c0, k0, f0, on, off] = p;
    // Half as much again: the slope jumps where q passes zero.
    return T(1.5) * T(speed) * max(abs(on), off);
  }
  template <class T>
  static T force(const std::array<T, 6>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [k_z, c0, k0, f0, on, off] = p;
    const auto& [q] = s;
    return c0 * in.v + k0 * in.x + k_z * q + f0;
  }
};

}  // namespace

extern const Part model_hysteretic_spring;
constexpr Part model_hysteretic_spring = compile<HystereticSpring>();

}  // namespace hysteron
