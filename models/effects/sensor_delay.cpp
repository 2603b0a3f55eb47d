// The force channel lags the motion channels by a few milliseconds (negative: leads), as of filters and multiplexers.
// The law below sees the delayed motion, so all of its force comes later.
//   x <- x - lag v + lag^2 a / 2,   v <- v - lag a + lag^2 j / 2
// Taylor's polynomials of a pure delay: for a sine of frequency w its phase is right but for (w lag)^3 / 6. a is the
// slope of the recorded velocity and j that of a, smoothed as its noise asks for (io/velocity.hpp). Parameters that
// depend on the drive follow that of `lag` earlier, linear between samples. Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SensorDelay {
  static constexpr std::string_view id = "sensor-delay";
  static constexpr std::string_view title = "Delay between the motion and force channels";
  static constexpr std::string_view reference = "standard; Taylor's polynomial of a delay";
  static constexpr std::string_view equations[] = {"x <- x - lag v + lag^2 a / 2, v <- v - lag a + lag^2 j / 2",
                                                   "i <- i(t - lag)"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "lag", .unit = "s", .meaning = "delay of the force channel", .box = {-0.02, 0.02}, .initial = 0},
  };
  static constexpr std::string_view kin[] = {"inertia", "velocity-lag", "compliance"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::force_delay, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::phase,
      .in_words = "a delay between the motion and force channels",
      .shows = "the force lags the motion[ and current] by the same time at every frequency, and leads where the lag is negative",
      .experiment =
          "[a current step at constant velocity and ]sines at frequencies an octave apart: a delay stays constant in "
          "ms",
      .rig_cause = "filters that differ between the channels, or channels sampled one after the other",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static void drive(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, Input<T>& in) {
    const auto& [lag] = p;
    in.x = in.x - lag * (in.v - T(0.5) * lag * in.a);
    in.v = in.v - lag * (in.a - T(0.5) * lag * in.jerk);
  }
  template <class T>
  static T recall(const std::array<T, 1>& p, const Command& command) {
    const auto& [lag] = p;
    return command.earlier(lag);
  }
};

}  // namespace

extern const Part effect_sensor_delay;
constexpr Part effect_sensor_delay = compile<SensorDelay>();

}  // namespace hysteron
