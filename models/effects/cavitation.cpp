// Cavitation: the chamber under suction cannot pull harder than its pressure allows. The force is limited on one side,
// a void opens, and the way back fills it before the force builds up again.
//   r = -kappa F,  s >= 0 the length of the void,  e = min(s / s_r, 1)
//   r > 1:  F <- F / r,        s' = |v| (1 - w / r) min(20 (r - 1), 1)   limited at |F| = 1 / |kappa|
//   r < 0:  F <- F (1 - e),    s' = -|v| e min(-20 r, 1)  the void is filled
// kappa > 0 limits the negative force, kappa < 0 the positive one; kappa = 0 is no cavitation. A viscous damper follows
// the rod at v / r, so that w = 1; one of dry friction stands still at less than its yield force, so that w = 0. The
// law below sees the recorded motion. s_r = 0.1 mm rounds the end of the dwell, and 5 % of the limit its beginning and
// the void's. Source: no accepted form is known.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Cavitation {
  static constexpr std::string_view id = "cavitation";
  static constexpr std::string_view title = "Cavitation (force limit on one side with dwell)";
  static constexpr std::string_view reference = "no accepted form; force limit and refill of the void";
  static constexpr std::string_view equations[] = {"r = -kappa F, e = min(s / s_r, 1)",
                                                   "r > 1: F <- F / r, s' = |v| (1 - w / r) min(20 (r - 1), 1)",
                                                   "r < 0: F <- F (1 - e), s' = -|v| e min(-20 r, 1)"};
  static constexpr int states = 1;
  static constexpr bool has_loaded_rate = true;
  // Limits of 0.9, 0.75, 0.55 and 0.35 of the peak force, to either side.
  static constexpr double starts[] = {0.055, -0.055, 0.067, -0.067, 0.09, -0.09, 0.14, -0.14};
  static constexpr Parameter parameters[] = {
      {"kappa",
       "kappa",
       "1/N",
       "inverse of the limiting force; its sign is opposite to that of the limited force",
       -1.0e-2,
       1.0e-2,
       0.0,
       Scale::linear,
       {-1, 0, 0}},
      {"w", "w", "1",
       "how the damper follows while the force is limited: 1 as a viscous one, 0 not at all, as one of dry friction",
       0.0, 1.0, 0.5, Scale::linear},
      {"s_r",
       "s_r",
       "m",
       "length over which the dwell ends",
       1.0e-5,
       1.0e-3,
       1.0e-4,
       Scale::logarithmic,
       {0, 1, 0},
       false,
       true},
  };

  template <class T>
  static std::array<T, 1> loaded_rate(const std::array<T, 3>& p, const std::array<T, 1>& s, const Input<T>& in,
                                      const T& below) {
    const T r = -p[0] * below;
    const T open = max(min(s[0] / p[2], T(1.0)), T(0.0));
    const T closing = open * min(T(-20.0) * r, T(1.0));
    const T over = max(r, T(1.0));
    const T opening = (T(1.0) - p[1] / over) * min(T(20.0) * (over - T(1.0)), T(1.0));
    const T growth = select(r < T(0.0), -closing, opening);
    return {abs(in.v) * growth};
  }
  template <class T>
  static T stiffness(const std::array<T, 3>& p, double speed) {
    return T(speed) / p[2];
  }
  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    const T r = -p[0] * below;
    const T open = max(min(s[0] / p[2], T(1.0)), T(0.0));
    return select(r < T(0.0), below * (T(1.0) - open), below / max(r, T(1.0)));
  }
};

}  // namespace

extern const Part effect_cavitation;
constexpr Part effect_cavitation = compile<Cavitation>();

}  // namespace hysteron
