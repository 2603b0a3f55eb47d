// The force differs between the two directions.
//   F <- F + e |F| + c_d |v|
// Of a damper of yield force f_y and damping c of which f_y differs by the share e_y and c by the share e_c, e is e_y
// and c_d = (e_c - e_y) c. So c_d follows the drive as the damping does, and shares are the same at every drive.
// The direction of e |F| is that of the force and not of the motion: friction keeps it for a while after a reversal, and
// so does what it differs by. e acts on all of the force below and is not linear together with the forces of the law.
// Source: standard; the passive damper literature writes separate coefficients for compression and rebound.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Asymmetry {
  static constexpr std::string_view id = "asymmetry";
  static constexpr std::string_view title = "Compression-rebound asymmetry";
  static constexpr std::string_view reference = "standard; separate coefficients for compression and rebound";
  static constexpr std::string_view equations[] = {"F <- F + e |F| + c_d |v|"};
  static constexpr int states = 0;
  static constexpr bool bends = true;
  static constexpr Parameter parameters[] = {
      {.name = "e", .unit = "1", .meaning = "share by which the force in the positive direction is larger than the mean of both", .box = {-0.8, 0.8}, .initial = 0, .limits = {.lower = -1, .upper = 1}},
      {.name = "c_d", .unit = "N s/m", .meaning = "what the damping in the positive direction is larger by, beyond that share", .box = {-5e3, 5e3}, .initial = 0, .linear = true, .role = PhysicalRole::damping, .limits = {}},
  };
  static constexpr std::string_view kin[] = {"cavitation"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::direction, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::direction,
      .in_words = "an asymmetry of compression and rebound",
      .shows = "the force of one direction is that of the other times a factor, at any place",
      .experiment = "the same sine around two mid-positions: an asymmetry is the same at both, a gas spring is not",
      .rig_cause = "a load cell that reads tension and compression with different gains, or whose gain changes with the force",
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [e, c_d] = p;
    return below + e * abs(below) + c_d * abs(in.v);
  }
};

}  // namespace

extern const Part effect_asymmetry;
constexpr Part effect_asymmetry = compile<Asymmetry>();

}  // namespace hysteron
