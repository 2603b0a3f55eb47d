// The zero of the load cell drifts in time.
//   F <- F + r t
// Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ForceDrift {
  static constexpr std::string_view id = "force-drift";
  static constexpr std::string_view title = "Drift of the load cell";
  static constexpr std::string_view reference = "standard";
  static constexpr std::string_view equations[] = {"F <- F + r t"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "r", .unit = "N/s", .meaning = "drift of the force", .box = {-100, 100}, .initial = 0, .linear = true},
  };
  static constexpr ContrastSense contrasts[] = {{ContrastKind::drift, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::force_channel,
      .in_words = "a drift of the load cell",
      .shows = "the force moves at a constant rate, at rest too",
      .experiment = "a minute of recording at rest before and after the run",
      .rig_cause = "a load cell or amplifier that warms up",
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [r] = p;
    return below + r * in.time;
  }
};

}  // namespace

extern const Part effect_force_drift;
constexpr Part effect_force_drift = compile<ForceDrift>();

}  // namespace hysteron
