// Moving mass: rod, fluid or fixture between damper and load cell.
//   F <- F + m a
// a is the slope of the recorded velocity, smoothed as its noise asks for (io/velocity.hpp). Source: Newton's second
// law.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Inertia {
  static constexpr std::string_view id = "inertia";
  static constexpr std::string_view title = "Inertia of fluid, rod or fixture";
  static constexpr std::string_view reference = "Newton";
  static constexpr std::string_view equations[] = {"F <- F + m a"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "m", .unit = "kg", .meaning = "effective mass", .box = {0, 500}, .initial = 0, .linear = true, .role = PhysicalRole::mass},
  };
  static constexpr std::string_view kin[] = {"sensor-delay", "velocity-lag"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::acceleration, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::phase,
      .in_words = "the inertia of fluid, rod or fixture",
      .shows = "a force in proportion to the acceleration, so that it grows with the square of the frequency",
      .experiment =
          "the same amplitude at frequencies an octave apart, and a run with the damper disconnected for the mass of "
          "the fixture",
      .rig_cause = "the mass of rod end, joint and fixture between the load cell and the damper",
      .one_form = true,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [m] = p;
    return fma(m, in.a, below);
  }
};

}  // namespace

extern const Part effect_inertia;
constexpr Part effect_inertia = compile<Inertia>();

}  // namespace hysteron
