// Moving mass: rod, fluid or fixture between damper and load cell.
//   F <- F + m a
//   h' = (v - h) / tau,  g' = (h - g) / tau,  a = (2 (v - h) - (h - g)) / tau
// The acceleration is derived from the velocity by two lags of tau = 2 ms, whose delays cancel: for a sine of frequency
// w its relative error is (w tau)^2, 0.06 % at 2 Hz and 6 % at 20 Hz. models/motion_filter.hpp takes the transient of
// the start at rest out. At the first sample a is zero; over the next 10 tau it is off by about tau times the jerk.
// Source: Newton's second law.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Inertia {
  static constexpr std::string_view id = "inertia";
  static constexpr std::string_view title = "Inertia of fluid, rod or fixture";
  static constexpr std::string_view reference = "Newton; two-stage lag derivative";
  static constexpr std::string_view equations[] = {
      "F <- F + m a", "a = (2 (v - h) - (h - g)) / tau, h' = (v - h) / tau, g' = (h - g) / tau"};
  static constexpr int states = 2;
  static constexpr Parameter parameters[] = {
      {"m", "m", "kg", "effective mass", 0.0, 5.0e1, 0.0, Scale::linear, {1, 1, -2}, true},
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
  };

  template <class T>
  static std::array<T, 2> rate(const std::array<T, 2>& p, const std::array<T, 2>& s, const Input<T>& in) {
    const T& tau = p[1];
    return {(in.v - s[0]) / tau, (s[0] - s[1]) / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& p, double /*speed*/) {
    const T& tau = p[1];
    return T(2.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 2>& s, const Input<T>& in, const T& below) {
    const T& m = p[0];
    const T& tau = p[1];
    return below + m * acceleration(in.v, s[0], s[1], tau, in.age);
  }
};

}  // namespace

extern const Part effect_inertia;
constexpr Part effect_inertia = compile<Inertia>();

}  // namespace hysteron
