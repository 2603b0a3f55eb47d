// A constant force, as of a gas accumulator's charge or an unbalanced load cell.
//   F <- F + f0
// Source: added to the modified Bouc-Wen model as its equation (15) in the PSO identification of the RD-8040-1.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct OffsetForce {
  static constexpr std::string_view id = "offset-force";
  static constexpr std::string_view title = "Constant offset force";
  static constexpr std::string_view reference = "accumulator pre-charge; load-cell zero";
  static constexpr std::string_view equations[] = {"F <- F + f0"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "f0", .unit = "N", .meaning = "offset force", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
  };
  static constexpr std::string_view kin[] = {"gas-spring"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::mean_force, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "a constant offset force",
      .shows = "the loops sit higher or lower by a constant force, at any position and speed",
      .experiment = "a slow full stroke around two mid-positions: an offset is the same in both, a gas spring is not",
      .rig_cause = "the zero of the load cell, or the weight of a fixture",
      .acts = Acts::by_place,
      .one_form = true,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& /*in*/, const T& below) {
    const auto& [f0] = p;
    return below + f0;
  }
};

}  // namespace

extern const Part effect_offset_force;
constexpr Part effect_offset_force = compile<OffsetForce>();

}  // namespace hysteron
