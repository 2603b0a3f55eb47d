// A linear spring in parallel, as of a mount or of an accumulator over a short stroke.
//   F <- F + k x
// Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct LinearStiffness {
  static constexpr std::string_view id = "linear-stiffness";
  static constexpr std::string_view title = "Linear stiffness";
  static constexpr std::string_view reference = "standard linear spring";
  static constexpr std::string_view equations[] = {"F <- F + k x"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "k", .unit = "N/m", .meaning = "stiffness", .box = {-2e4, 1e5}, .initial = 0, .linear = true, .role = PhysicalRole::stiffness},
  };
  static constexpr std::string_view kin[] = {"gas-spring", "cubic-stiffness", "end-stop"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::stiffness, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "a linear stiffness",
      .shows = "a force in proportion to the displacement, at any speed",
      .experiment = "a slow full stroke around two mid-positions",
      .rig_cause = "a spring or flexure beside the damper",
      .acts = Acts::by_place,
      .one_form = true,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [k] = p;
    return below + k * in.x;
  }
};

}  // namespace

extern const Part effect_linear_stiffness;
constexpr Part effect_linear_stiffness = compile<LinearStiffness>();

}  // namespace hysteron
