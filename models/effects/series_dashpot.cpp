// A dashpot in series with everything below: the force rolls off at low speed and relaxes.
//   F = F_law(x - d, v - d'),   d' = F / c1
// The deflection is that of the dashpot up to |d| = 0.5 m and saturates beyond, towards 1 m, so that a law with
// negative stiffness or an offset force cannot run away. Source: the dashpot c1 of Spencer, Dyke, Sain, Carlson, J.
// Eng. Mech. 123 (1997) 230-238, put in series with the whole law.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SeriesDashpot {
  static constexpr std::string_view id = "series-dashpot";
  static constexpr std::string_view title = "Series dashpot (low-speed roll-off)";
  static constexpr std::string_view reference =
      "Spencer et al., J. Eng. Mech. 123 (1997) 230-238; Maxwell dashpot in series with the law";
  static constexpr std::string_view equations[] = {"F = F_law(x - d, v - d')", "d' = e F, e = 1 / c1"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "e", .symbol = "1/c1", .unit = "m/(N s)", .meaning = "speed of the series dashpot per force", .box = {0, 3e-4}, .initial = 0},
  };
  static constexpr std::string_view kin[] = {"compliance"};
  static constexpr PartOfLaw part_of[] = {{"modified-bouc-wen", "bouc-wen", "c1"}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::rest_relaxation, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::series,
      .in_words = "a series dashpot (roll-off at low speed)",
      .shows = "the force rolls off at low speed and relaxes while the rod is held",
      .experiment = "slow triangles from 1 to 20 mm/s, and a hold after a fast stroke to see the force relax",
      .rig_cause = "a force channel that passes no steady force, as behind AC coupling or a charge amplifier",
      .kin = kin,
      .part_of = part_of,
      .contrasts = contrasts,
  };

  template <class T>
  static Yield<T> yield(const std::array<T, 1>& p, const T& q) {
    const auto& [e] = p;
    constexpr double stroke = 0.5;
    const T over = max(abs(q) - T(stroke), T(0.0)) * T(1.0 / stroke);
    const T limited = tanh(over);
    const T slope = T(1.0) - limited * limited;
    const T size = min(abs(q), T(stroke)) + T(stroke) * limited;
    return {select(q < T(0.0), -size, size),
            slope,
            select(q < T(0.0), T(2.0 / stroke), T(-2.0 / stroke)) * slope * limited,
            e,
            T(0.0),
            T(0.0)};
  }
};

}  // namespace

extern const Part effect_series_dashpot;
constexpr Part effect_series_dashpot = compile<SeriesDashpot>();

}  // namespace hysteron
