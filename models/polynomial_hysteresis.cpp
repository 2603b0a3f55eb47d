// Polynomial of the velocity on either branch of the loop.
//   F = w sum_i rise_i r^i + (1 - w) sum_i fall_i r^i,   r = v / v_ref, i = 0 .. 6
//   w = (1 + tanh(a / a_s)) / 2: 1 while the velocity rises, 0 while it falls
// The source multiplies powers of v; v_ref makes every coefficient a force. A polynomial of sixth degree says nothing
// beyond the speeds it was fitted on.
// The acceleration is that of models/motion_filter.hpp with tau = 2 ms; a_s = 0.2 m/s^2 rounds the change of branch.
// Source: Choi, Lee, Park, J. Sound Vib. 245 (2001) 375-383, doi 10.1006/jsvi.2000.3539.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

constexpr Parameter coefficient(std::string_view name, std::string_view meaning, double initial) {
  return {.name = name, .unit = "N", .meaning = meaning, .box = {-1e4, 1e4}, .initial = initial, .linear = true};
}

struct PolynomialHysteresis {
  static constexpr std::string_view id = "polynomial-hysteresis";
  static constexpr std::string_view title = "Polynomial of velocity per branch (Choi)";
  static constexpr std::string_view reference =
      "Choi, Lee, Park, J. Sound Vib. 245 (2001) 375-383, doi 10.1006/jsvi.2000.3539";
  static constexpr std::string_view equations[] = {
      "F = w sum_i rise_i (v / v_ref)^i + (1 - w) sum_i fall_i (v / v_ref)^i, i = 0 .. 6",
      "w = (1 + tanh(a / a_s)) / 2", "a from h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr int terms = 7;
  static constexpr Parameter parameters[] = {
      coefficient("rise_0", "rising velocity, constant term", 0),
      coefficient("rise_1", "rising velocity, coefficient of r", 500),
      coefficient("rise_2", "rising velocity, coefficient of r^2", 0),
      coefficient("rise_3", "rising velocity, coefficient of r^3", 0),
      coefficient("rise_4", "rising velocity, coefficient of r^4", 0),
      coefficient("rise_5", "rising velocity, coefficient of r^5", 0),
      coefficient("rise_6", "rising velocity, coefficient of r^6", 0),
      coefficient("fall_0", "falling velocity, constant term", 0),
      coefficient("fall_1", "falling velocity, coefficient of r", 500),
      coefficient("fall_2", "falling velocity, coefficient of r^2", 0),
      coefficient("fall_3", "falling velocity, coefficient of r^3", 0),
      coefficient("fall_4", "falling velocity, coefficient of r^4", 0),
      coefficient("fall_5", "falling velocity, coefficient of r^5", 0),
      coefficient("fall_6", "falling velocity, coefficient of r^6", 0),
      {.name = "v_ref", .unit = "m/s", .meaning = "speed that normalises the velocity", .box = {0.1, 1}, .initial = 0.3, .scale = Scale::logarithmic, .fixed = true},
      acceleration_lag,
      acceleration_rounding,
  };

  // The card by name.
  template <class T>
  struct Named {
    std::span<const T, terms> rise;
    std::span<const T, terms> fall;
    const T& v_ref;
    const T& tau;
    const T& a_s;
    explicit Named(const std::array<T, 17>& p)
        : rise(p.data(), terms), fall(p.data() + terms, terms), v_ref(p[14]), tau(p[15]), a_s(p[16]) {}
  };
  template <class T>
  static std::array<T, 1> rate(const std::array<T, 17>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [h] = s;
    return {(in.v - h) / Named(p).tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 17>& p, double /*speed*/) {
    // Four times the bound: the acceleration is the lagged velocity's error over tau.
    return T(4.0) / Named(p).tau;
  }
  template <class T>
  static T force(const std::array<T, 17>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const Named own(p);
    const auto& [h] = s;
    const T r = in.v / own.v_ref;
    T rise = own.rise.back();
    T fall = own.fall.back();
    for (std::size_t i = terms - 1; i-- > 0;) {
      rise = rise * r + own.rise[i];
      fall = fall * r + own.fall[i];
    }
    const T w = T(0.5) + T(0.5) * tanh(acceleration(in.v, h, own.tau, in.age) / own.a_s);
    return w * rise + (T(1.0) - w) * fall;
  }
};

}  // namespace

extern const Part model_polynomial_hysteresis;
constexpr Part model_polynomial_hysteresis = compile<PolynomialHysteresis>();

}  // namespace hysteron
