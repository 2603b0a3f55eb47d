// Cavitation: the chamber under suction cannot pull harder than its pressure allows. The force is limited on one side,
// a void opens, and the way back fills it before the force builds up again.
//   r = -kappa F,  s >= 0 the length of the void,  e = tanh(s / s_r)
//   r > 1:       F <- F / r,        s' = |v| (r - 1) / (w + r - 1)   limited at |F| = 1 / |kappa|
//   0 <= r <= 1: F,                 s' = 0                           on the way back the damper unloads first,
//   r < 0:       F <- F (1 - e),    s' = -sgn(kappa) v e b           then the void is filled without force
//   b = tanh(-20 r), and s' = -q s besides: fluid that flows into the void
// kappa > 0 limits the negative force, kappa < 0 the positive one; kappa = 0 is no cavitation. While the force is
// limited a damper of yield force f_y and viscous damping follows the rod at the speed that leaves w = 1 - f_y |kappa|
// of the limit to the viscous part: v w / (w + r - 1); w = 1 is a viscous damper, w = 0 one of dry friction, which
// stands still, and w > 1 one whose void is smaller than the rod leaves it, as gas comes out of solution. The law below
// sees the recorded motion; over s_r the force builds up again. Source: no accepted form is known.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Cavitation {
  static constexpr std::string_view id = "cavitation";
  static constexpr std::string_view title = "Cavitation (force limit on one side with dwell)";
  static constexpr std::string_view reference = "no accepted form; force limit and refill of the void";
  static constexpr std::string_view equations[] = {"r = -kappa F, e = tanh(s / s_r)",
                                                   "r > 1: F <- F / r, s' = |v| (r - 1) / (w + r - 1) - q s",
                                                   "0 <= r <= 1: s' = -q s",
                                                   "r < 0: F <- F (1 - e), s' = -sgn(kappa) v e tanh(-20 r) - q s"};
  static constexpr int states = 1;
  // Limits of 0.96, 0.85, 0.7 and 0.45 of the peak force, to either side.
  static constexpr double starts[] = {0.052, -0.052, 0.059, -0.059, 0.071, -0.071, 0.11, -0.11};
  static constexpr Parameter parameters[] = {
      {.name = "kappa", .unit = "1/N", .meaning = "inverse of the limiting force; its sign is opposite to that of the limited force", .box = {-0.01, 0.01}, .initial = 0},
      {.name = "w", .unit = "1", .meaning = "viscous part of the limiting force; above 1 the void is smaller than the rod leaves it", .box = {0.01, 100}, .initial = 0.1, .scale = Scale::logarithmic},
      {.name = "q", .unit = "1/s", .meaning = "rate at which fluid flows into the void", .box = {0, 100}, .initial = 0},
      {.name = "s_r", .unit = "m", .meaning = "length over which the dwell ends", .box = {2e-5, 2e-3}, .initial = 2e-4, .scale = Scale::logarithmic},
  };
  static constexpr std::string_view kin[] = {"asymmetry"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::one_sided_limit, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::direction,
      .in_words = "cavitation (a force limit on one side, with dwell)",
      .shows = "the force of one direction stops growing, and on the way back the void is filled without force",
      .experiment = "the same run at two gas pressures and at rising speed",
      .rig_cause = "a joint that lifts off in one direction",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static std::array<T, 1> loaded_rate(const std::array<T, 4>& p, const std::array<T, 1>& state, const Input<T>& in,
                                      const T& below) {
    const auto& [kappa, w, q, s_r] = p;
    const auto& [s] = state;
    const T r = -kappa * below;
    const T e = tanh(s / s_r);
    const T over = max(r - T(1.0), T(0.0));
    // Within a twentieth of the limit the void begins to close, so that its rate has no jump.
    const T b = tanh(T(20.0) * max(-r, T(0.0)));
    const T closing = select(T(0.0) < kappa, in.v, -in.v) * e * b;
    return {abs(in.v) * over / (w + over) - closing - q * s};
  }
  template <class T>
  static T stiffness(const std::array<T, 4>& p, double speed) {
    const auto& [kappa, w, q, s_r] = p;
    return T(speed) / s_r + q;
  }
  template <class T>
  static T force(const std::array<T, 4>& p, const std::array<T, 1>& state, const Input<T>&, const T& below) {
    const auto& [kappa, w, q, s_r] = p;
    const auto& [s] = state;
    const T r = -kappa * below;
    const T e = tanh(s / s_r);
    return select(r < T(0.0), below * (T(1.0) - e), below / max(r, T(1.0)));
  }
};

}  // namespace

extern const Part effect_cavitation;
constexpr Part effect_cavitation = compile<Cavitation>();

}  // namespace hysteron
