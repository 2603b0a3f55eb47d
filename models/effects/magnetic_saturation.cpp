// Saturation of the magnetic circuit: the parameters that follow the current see less of it.
//   i <- i_s tanh(i / i_s),   sigma = 1 / i_s^2
// sigma = 0 is no saturation. Without parameters that follow the drive the effect does nothing, and at one level of the
// drive it cannot be told from them.
// Source: standard saturation curve.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct MagneticSaturation {
  static constexpr std::string_view id = "magnetic-saturation";
  static constexpr std::string_view title = "Magnetic saturation";
  static constexpr std::string_view reference = "standard saturation curve";
  static constexpr std::string_view equations[] = {"i <- i_s tanh(i / i_s), sigma = 1 / i_s^2"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "sigma", .symbol = "1/i_s^2", .unit = "1/A^2", .meaning = "inverse square of the drive at which the circuit saturates", .box = {0, 25}, .initial = 0},
  };
  // At two levels it is another slope of the force with the drive.
  static constexpr Need needs[] = {Need::drive, Need::three_drive_levels};
  static constexpr std::string_view kin[] = {"coil-lag", "magnetic-remanence"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::drive_bend, Sense::negative}};
  static constexpr Knowledge knowledge = {
      .family = families::drive_path,
      .in_words = "magnetic saturation",
      .shows = "the force rises less and less with the current",
      .experiment = "at least five current levels up to the highest",
      .rig_cause = "an amplifier at its limit, or one whose gain changed",
      .needs = needs,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T excite(const std::array<T, 1>& p, std::array<T, excitation_memory>& /*memory*/, double /*elapsed*/,
                  const T& drive) {
    const auto& [sigma] = p;
    const T a = sigma * drive * drive;
    const T root = sqrt(max(a, T(1e-4)));
    const T series = T(1.0) - a * (T(1.0 / 3.0) - a * T(2.0 / 15.0));
    return drive * select(a < T(1e-4), series, tanh(root) / root);
  }
};

}  // namespace

extern const Part effect_magnetic_saturation;
constexpr Part effect_magnetic_saturation = compile<MagneticSaturation>();

}  // namespace hysteron
