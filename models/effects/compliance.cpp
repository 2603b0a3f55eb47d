// A spring in series with the damper: compressibility of the fluid, compliance of rod and mounts.
//   F = F_law(x - d, v - d') = q + tau q',   d = C q,   C = 1 / k_s
// A small damping tau k_s in the spring, tau = 0.5 ms, makes d' a function of the state for every law.
// Source: Maxwell element; standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Compliance {
  static constexpr std::string_view id = "compliance";
  static constexpr std::string_view title = "Series compliance";
  static constexpr std::string_view reference = "standard (Maxwell element)";
  static constexpr std::string_view equations[] = {"F = F_law(x - d, v - d') = q + tau q'", "d = C q"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "C", .symbol = "1/k_s", .unit = "m/N", .meaning = "compliance of the series spring", .box = {0, 1e-5}, .initial = 0},
      {.name = "tau", .unit = "s", .meaning = "relaxation time of the spring's own damping", .box = {2e-4, 5e-3}, .initial = 5e-4, .scale = Scale::logarithmic, .fixed = true},
  };
  static constexpr std::string_view kin[] = {"clearance", "entrapped-gas", "series-dashpot", "sensor-delay"};
  static constexpr KindredParameter kindred[] = {{"C", "clearance", "C_c", 1.0}, {"C", "entrapped-gas", "C_c", 1.0}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::force_travel, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::series,
      .in_words = "a compliance in series",
      .shows = "the larger the force, the further the rod travels before the force has reversed",
      .experiment =
          "[current steps while the damper is held, and the same stroke at three currents|the same stroke at three "
          "speeds]: the deflection of a compliance grows with the force",
      .rig_cause = "a load cell, fixture or joint that gives between the displacement sensor and the damper",
      .kin = kin,
      .kindred = kindred,
      .contrasts = contrasts,
  };

  template <class T>
  static Yield<T> yield(const std::array<T, 2>& p, const T& q) {
    const auto& [C, tau] = p;
    return {C * q, C, T(0.0), T(1.0) / tau, T(1.0), T(0.0)};
  }
};

}  // namespace

extern const Part effect_compliance;
constexpr Part effect_compliance = compile<Compliance>();

}  // namespace hysteron
