// The force channel lags the motion channels by a few milliseconds (negative: leads), as of filters and multiplexers.
// The law below sees the lagged motion, so all of its force comes later.
//   v <- v - lag a,   x <- x - lag (v - tau a),   a = (v - h) / tau, h' = (v - h) / tau
// It is the exact first-order lag of displacement and velocity for lag = tau, and the identity for lag = 0. tau = 2 ms.
// The drive is not delayed: parameters that depend on the current follow the recorded one.
// Source: standard.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SensorDelay {
  static constexpr std::string_view id = "sensor-delay";
  static constexpr std::string_view title = "Delay between the motion and force channels";
  static constexpr std::string_view reference = "standard; first-order lead or lag";
  static constexpr std::string_view equations[] = {"v <- v - lag a, x <- x - lag (v - tau a)",
                                                   "a from h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr bool has_drive = true;
  static constexpr Parameter parameters[] = {
      {"lag", "lag", "s", "delay of the force channel", -2.0e-2, 2.0e-2, 0.0, Scale::linear, {0, 1, -1}},
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
    const T a = acceleration(in.v, s[0], tau, in.age);
    in.x = in.x - lag * (in.v - tau * a);
    in.v = in.v - lag * a;
  }
  template <class T>
  static T force(const std::array<T, 2>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& /*in*/, const T& below) {
    return below;
  }
};

}  // namespace

extern const Part effect_sensor_delay;
constexpr Part effect_sensor_delay = compile<SensorDelay>();

}  // namespace hysteron
