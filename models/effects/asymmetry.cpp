// The force differs between the two directions of motion.
//   F <- F (1 + e tanh(v / v_s)),   v_s = 1 mm/s
// It acts on all of the force below, so e is not linear together with the forces of the law.
// Source: standard; the passive damper literature writes separate coefficients for compression and rebound.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Asymmetry {
  static constexpr std::string_view id = "asymmetry";
  static constexpr std::string_view title = "Compression-rebound asymmetry";
  static constexpr std::string_view reference = "standard; separate coefficients for compression and rebound";
  static constexpr std::string_view equations[] = {"F <- F (1 + e tanh(v / v_s))"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "e", .unit = "1", .meaning = "relative difference of either direction from the mean", .box = {-0.8, 0.8}, .initial = 0, .limits = {.lower = -1, .upper = 1}},
      cards::v_s,
  };
  static constexpr std::string_view kin[] = {"cavitation"};
  static constexpr Knowledge knowledge = {
      .family = families::direction,
      .in_words = "an asymmetry of compression and rebound",
      .shows = "the force of one direction of motion is that of the other times a factor, at any place and speed",
      .experiment = "the same sine around two mid-positions: asymmetry follows the velocity, a gas spring the position",
      .kin = kin,
  };

  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [e, v_s] = p;
    return below * (T(1.0) + e * tanh(in.v / v_s));
  }
};

}  // namespace

extern const Part effect_asymmetry;
constexpr Part effect_asymmetry = compile<Asymmetry>();

}  // namespace hysteron
