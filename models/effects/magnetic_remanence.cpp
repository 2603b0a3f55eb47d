// Remanence of the magnetic circuit: after a step down of the current the field stays higher than after a step up to
// the same current, and stays so.
//   m <- min(max(m, i - w), i + w),   i <- i + rho (m - i)
// m is a play of half width w behind the current; it starts as near to s i as the play allows, i the first
// current of the recording: s = 1 where the current was the same long before, s = 0 where it was switched on from a
// circuit without field. It does not change while the current is constant. Without parameters that follow the drive the
// effect does nothing.
// Source: play operator; Krasnosel'skii, Pokrovskii, Systems with Hysteresis, Springer 1989.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct MagneticRemanence {
  static constexpr std::string_view id = "magnetic-remanence";
  static constexpr std::string_view title = "Magnetic remanence";
  static constexpr std::string_view reference =
      "play operator; Krasnosel'skii, Pokrovskii, Systems with Hysteresis, Springer 1989";
  static constexpr std::string_view equations[] = {"m <- min(max(m, i - w), i + w)", "i <- i + rho (m - i)"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "rho", .unit = "1", .meaning = "share of the drive that remains behind", .box = {0, 1}, .initial = 0, .limits = {.lower = 0, .upper = 1}},
      {.name = "w", .unit = "A", .meaning = "half width of the play", .box = {0.01, 2}, .initial = 0.2, .scale = Scale::logarithmic},
      {.name = "s", .unit = "1", .meaning = "field over current before the recording", .box = {0, 1}, .initial = 1, .limits = {.lower = -1, .upper = 1}},
  };
  static constexpr Need needs[] = {Need::drive, Need::returning_drive};
  static constexpr std::string_view kin[] = {"coil-lag", "magnetic-saturation"};
  static constexpr PartOfLaw part_of[] = {{"preisach"}};
  // The current was the same long before, or switched on from a circuit without field.
  static constexpr BoxLimit ends_as[] = {{id, "s", BoxEnd::upper}, {id, "s", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::drive_memory, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::drive_path,
      .in_words = "magnetic remanence",
      .shows =
          "the force is larger after a step down of the current than after a step up to the same current, and stays so",
      .experiment = "a current staircase up and down at constant velocity",
      .rig_cause = "a current that was commanded and not measured",
      .needs = needs,
      .kin = kin,
      .ends_as = ends_as,
      .part_of = part_of,
      .contrasts = contrasts,
  };

  template <class T>
  static T excite(const std::array<T, 3>& p, std::array<T, excitation_memory>& memory, double elapsed, const T& drive) {
    const auto& [rho, w, s] = p;
    T& m = memory[0];
    m = min(max(elapsed < 0.0 ? s * drive : m, drive - w), drive + w);
    return drive + rho * (m - drive);
  }
};

}  // namespace

extern const Part effect_magnetic_remanence;
constexpr Part effect_magnetic_remanence = compile<MagneticRemanence>();

}  // namespace hysteron
