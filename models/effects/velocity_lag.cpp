// The recorded velocity lags the one that acts on the law below, as where its channel went through a filter that force
// and displacement did not; negative lag: it leads.
//   v <- v + lag a,   a = (v - h) / tau, h' = (v - h) / tau
// It is the exact first-order filter for lag = -tau, and the identity for lag = 0. tau = 2 ms.
// Source: standard.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct VelocityLag {
  static constexpr std::string_view id = "velocity-lag";
  static constexpr std::string_view title = "Lag of the velocity channel";
  static constexpr std::string_view reference = "standard; first-order lead or lag";
  static constexpr std::string_view equations[] = {"v <- v + lag a", "a from h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr bool has_drive = true;
  static constexpr Parameter parameters[] = {
      {"lag",
       "lag",
       "s",
       "lag of the recorded velocity behind the one that acts",
       -2.0e-2,
       2.0e-2,
       0.0,
       Scale::linear,
       {0, 1, -1}},
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
  static std::array<T, 1> rate(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const T& tau = p[1];
    return {(in.v - s[0]) / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& p, double /*speed*/) {
    const T& tau = p[1];
    return T(1.0) / tau;
  }
  template <class T>
  static void drive(const std::array<T, 2>& p, const std::array<T, 1>& s, Input<T>& in) {
    const T& lag = p[0];
    const T& tau = p[1];
    in.v = in.v + lag * acceleration(in.v, s[0], tau, in.age);
  }
  template <class T>
  static T force(const std::array<T, 2>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& /*in*/, const T& below) {
    return below;
  }
};

}  // namespace

extern const Part effect_velocity_lag;
constexpr Part effect_velocity_lag = compile<VelocityLag>();

}  // namespace hysteron
