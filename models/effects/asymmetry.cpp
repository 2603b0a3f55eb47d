// The force differs between the two directions.
//   F <- F + (e + e_v |v| / (|v| + v_c)) |F|
// The direction is that of the force and not of the motion: friction keeps it for a while after a reversal, and so does
// what it differs by. Friction and damping need not differ alike: of a force f_y + c |v| of which f_y differs by e and
// c by e + e_v, the whole differs by e + e_v |v| / (|v| + f_y / c). It acts on all of the force below, so that e and
// e_v are not linear together with the forces of the law.
// Source: standard; the passive damper literature writes separate coefficients for compression and rebound.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Asymmetry {
  static constexpr std::string_view id = "asymmetry";
  static constexpr std::string_view title = "Compression-rebound asymmetry";
  static constexpr std::string_view reference = "standard; separate coefficients for compression and rebound";
  static constexpr std::string_view equations[] = {"F <- F + (e + e_v |v| / (|v| + v_c)) |F|"};
  static constexpr int states = 0;
  static constexpr bool bends = true;
  static constexpr Parameter parameters[] = {
      {.name = "e", .unit = "1", .meaning = "relative difference of either direction from the mean at low speed", .box = {-0.8, 0.8}, .initial = 0, .limits = {.lower = -1, .upper = 1}},
      {.name = "e_v", .unit = "1", .meaning = "what that gains with the speed", .box = {-0.8, 0.8}, .initial = 0},
      {.name = "v_c", .unit = "m/s", .meaning = "speed at which half of that is gained: yield force over damping", .box = {5e-3, 1}, .initial = 0.05, .scale = Scale::logarithmic},
  };
  static constexpr std::string_view kin[] = {"cavitation"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::direction, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::direction,
      .in_words = "an asymmetry of compression and rebound",
      .shows = "the force of one direction is that of the other times a factor, at any place",
      .experiment = "the same sine around two mid-positions: an asymmetry is the same at both, a gas spring is not",
      .rig_cause = "a load cell that reads tension and compression with different gains",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 3>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [e, e_v, v_c] = p;
    const T speed = abs(in.v);
    return below + (e + e_v * speed / (speed + v_c)) * abs(below);
  }
};

}  // namespace

extern const Part effect_asymmetry;
constexpr Part effect_asymmetry = compile<Asymmetry>();

}  // namespace hysteron
