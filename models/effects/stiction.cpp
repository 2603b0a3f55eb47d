// After a rest the first travel needs more force: settled particles, thixotropy, dry seals.
//   F <- F (1 + a exp(-s / L)),   s' = |v|
// s is the travelled distance since the start of the recording. a is not linear together with the forces of the law.
// Source: no accepted form is known; the exponential is the simplest that fades with travel.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Stiction {
  static constexpr std::string_view id = "stiction";
  static constexpr std::string_view title = "First-travel stiction";
  static constexpr std::string_view reference = "no accepted form; exponential in the travelled distance";
  static constexpr std::string_view equations[] = {"F <- F (1 + a exp(-s / L))", "s' = |v|"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "a", .unit = "1", .meaning = "relative excess of the force at the start", .box = {-0.5, 2}, .initial = 0},
      {.name = "L", .unit = "m", .meaning = "distance over which it fades", .box = {1e-3, 1}, .initial = 0.05, .scale = Scale::logarithmic},
  };
  static constexpr std::string_view kin[] = {"self-heating", "degradation"};
  // What has not faded over all of the travel is a loss for good.
  static constexpr BoxLimit ends_as[] = {{"degradation", "L", BoxEnd::upper}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::pause_recovery, Sense::positive}, {ContrastKind::first_travel, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::slow_loss,
      .in_words = "first-travel stiction",
      .shows = "the first travel after a rest needs more force than the travel after it",
      .experiment = "the same run after rests of different length",
      .rig_cause = "a joint that settles only with the first travel",
      .kin = kin,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> begin(const std::array<T, 2>& /*p*/, std::span<const EarlierWork> /*earlier*/) {
    return {T(0.0)};
  }
  template <class T>
  static std::array<T, 1> rate(const std::array<T, 2>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return {abs(in.v)};
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& /*p*/, double /*speed*/) {
    return T(0.0);
  }
  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 1>& state, const Input<T>& /*in*/, const T& below) {
    const auto& [a, L] = p;
    const auto& [s] = state;
    return below * (T(1.0) + a * exp(-s / L));
  }
};

}  // namespace

extern const Part effect_stiction;
constexpr Part effect_stiction = compile<Stiction>();

}  // namespace hysteron
