// The force falls for good with the work done, as of wear, leakage or fluid breakdown.
//   F <- F / (1 + d E),   E' = F v
// E is the work done on the damper so far: its dissipated energy but for what springs hold. Unlike self-heating it does
// not recover: where the starts of the recordings are told, E goes on from one to the next. It acts on all of the force
// below, so nothing below is linear. 1 + d E is kept above 0.1.
// Source: the strength degradation 1 / nu of Baber, Noori, J. Eng. Mech. 111 (1985) 1010-1026, applied to the
// whole force.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Degradation {
  static constexpr std::string_view id = "degradation";
  static constexpr std::string_view title = "Degradation";
  static constexpr std::string_view reference = "loss of force over accumulated work; after Baber, Noori 1985";
  static constexpr std::string_view equations[] = {"F <- F / (1 + d E)", "E' = F v"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "d", .unit = "1/J", .meaning = "relative loss of force per work done", .box = {0, 2e-3}, .initial = 0, .limits = {}},
  };
  static constexpr std::string_view kin[] = {"self-heating", "stiction"};
  static constexpr PartOfLaw part_of[] = {{"baber-noori"}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::energy_fade, Sense::positive}, {ContrastKind::carried_fade, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::slow_loss,
      .in_words = "a degradation with the work done",
      .shows = "the force falls with the work done and does not come back after a pause",
      .experiment = "the first recording again at the end of the campaign, cold, each file with its start",
      .rig_cause = "[a supply that lets the current sink, or ]a force channel whose gain sinks",
      .kin = kin,
      .part_of = part_of,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> begin(const std::array<T, 1>& /*p*/, std::span<const EarlierWork> earlier) {
    return {left_of(earlier, T(0.0))};
  }
  template <class T>
  static std::array<T, 1> loaded_rate(const std::array<T, 1>& p, const std::array<T, 1>& s, const Input<T>& in,
                                      const T& below) {
    const auto& [d] = p;
    const auto& [E] = s;
    return {below / max(T(1.0) + d * E, T(0.1)) * in.v};
  }
  template <class T>
  static T stiffness(const std::array<T, 1>& /*p*/, double /*speed*/) {
    return T(0.0);
  }
  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    const auto& [d] = p;
    const auto& [E] = s;
    return below / max(T(1.0) + d * E, T(0.1));
  }
};

}  // namespace

extern const Part effect_degradation;
constexpr Part effect_degradation = compile<Degradation>();

}  // namespace hysteron
