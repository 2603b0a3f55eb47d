// The recorded velocity lags the one that acts on the law below, as where its channel went through a filter that force
// and displacement did not; negative lag: it leads.
//   v <- v + lag a
// It undoes a first-order filter of time constant lag exactly. a is the slope of the recorded velocity, smoothed as its
// noise asks for (io/velocity.hpp). Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct VelocityLag {
  static constexpr std::string_view id = "velocity-lag";
  static constexpr std::string_view title = "Lag of the velocity channel";
  static constexpr std::string_view reference = "standard; inverse of a first-order filter";
  static constexpr std::string_view equations[] = {"v <- v + lag a"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "lag", .unit = "s", .meaning = "lag of the recorded velocity behind the one that acts", .box = {-0.02, 0.02}, .initial = 0},
  };
  static constexpr Need needs[] = {Need::lagging_velocity};
  static constexpr std::string_view kin[] = {"inertia", "sensor-delay"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::velocity_delay, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::phase,
      .in_words = "a lag of the velocity channel",
      .shows = "the recorded velocity lags the slope of the displacement by the same time at every frequency",
      .experiment =
          "a sine at each of three frequencies with displacement and velocity recorded: the slope of the displacement "
          "shows the lag of the velocity channel",
      .rig_cause = "a filter in the velocity's channel",
      .needs = needs,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static void drive(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, Input<T>& in) {
    const auto& [lag] = p;
    in.v = fma(lag, in.a, in.v);
  }
};

}  // namespace

extern const Part effect_velocity_lag;
constexpr Part effect_velocity_lag = compile<VelocityLag>();

}  // namespace hysteron
