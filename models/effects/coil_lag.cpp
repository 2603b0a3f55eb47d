// The current in the coil lags the recorded command, by inductance, driver and eddy currents; where these matter, more
// when the current falls than when it rises.
//   i' = (i_cmd - i) / tau_i,   tau_i = tau for a rising current, tau r for a falling one
// The parameters that follow the drive follow i. Exact for a command that is linear between samples, where the current
// does not turn within a sample. i starts at the first command, so that nothing changes while the current is constant,
// and without parameters that follow the drive the effect does nothing.
// Source: first-order lag of the drive as in Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238; the second
// time constant is ours.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct CoilLag {
  static constexpr std::string_view id = "coil-lag";
  static constexpr std::string_view title = "Lag of the coil current";
  static constexpr std::string_view reference =
      "Spencer et al., J. Eng. Mech. 123 (1997) 230-238; first-order drive lag";
  static constexpr std::string_view equations[] = {"i' = (i_cmd - i) / tau, rising current",
                                                   "i' = (i_cmd - i) / (tau r), falling current", "i_cmd <- i"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "tau", .unit = "s", .meaning = "time constant of the rising current", .box = {0, 0.5}, .initial = 0, .dimension = {}},
      {.name = "r", .unit = "1", .meaning = "time constant of the falling current over that of the rising", .box = {0.5, 3}, .initial = 1, .scale = Scale::logarithmic},
  };
  static constexpr Need needs[] = {Need::drive, Need::changing_drive};
  static constexpr std::string_view kin[] = {"magnetic-remanence", "magnetic-saturation"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::drive_lag, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::drive_path,
      .in_words = "a lag of the coil current",
      .shows = "the force follows a step of the current late, by the same time at any speed",
      .experiment = "current steps up and down at constant velocity, at several levels",
      .rig_cause = "a current that was commanded and not measured, or a filter in its channel",
      .needs = needs,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T excite(const std::array<T, 2>& p, std::array<T, excitation_memory>& memory, double elapsed, const T& drive) {
    const auto& [tau, r] = p;
    T& current = memory[0];
    T& command = memory[1];
    if (elapsed <= 0.0) {
      current = drive;
    } else {
      const auto rising = current < drive;
      const T tau_i = max(select(rising, tau, tau * r), T(1e-9));
      const T slope = (drive - command) / T(elapsed);
      const T behind = slope * tau_i;
      current = drive - behind + (current - command + behind) * exp(T(-elapsed) / tau_i);
    }
    command = drive;
    return current;
  }
};

}  // namespace

extern const Part effect_coil_lag;
constexpr Part effect_coil_lag = compile<CoilLag>();

}  // namespace hysteron
