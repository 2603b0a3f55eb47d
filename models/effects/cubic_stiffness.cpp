// A cubic spring in parallel: a stiffness that grows (or falls) towards both ends of the stroke.
//   F <- F + k3 x^3
// Source: standard (Duffing).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct CubicStiffness {
  static constexpr std::string_view id = "cubic-stiffness";
  static constexpr std::string_view title = "Cubic stiffness";
  static constexpr std::string_view reference = "standard Duffing spring";
  static constexpr std::string_view equations[] = {"F <- F + k3 x^3"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "k3", .unit = "N/m^3", .meaning = "cubic stiffness", .box = {-1e8, 1e8}, .initial = 0, .linear = true},
  };
  static constexpr std::string_view kin[] = {"linear-stiffness", "gas-spring", "end-stop", "pinching"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::stiffness_cubic, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "a cubic stiffness",
      .shows = "a stiffness that grows, or where k3 is negative falls, towards both ends of the stroke",
      .experiment = "a slow full stroke around two mid-positions",
      .rig_cause = "a linkage or guide that binds towards the ends of the stroke",
      .acts = Acts::by_place,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [k3] = p;
    return below + k3 * in.x * in.x * in.x;
  }
};

}  // namespace

extern const Part effect_cubic_stiffness;
constexpr Part effect_cubic_stiffness = compile<CubicStiffness>();

}  // namespace hysteron
