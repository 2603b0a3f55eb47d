// A linear dashpot in parallel.
//   F <- F + c v
// Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ViscousDamping {
  static constexpr std::string_view id = "viscous-damping";
  static constexpr std::string_view title = "Viscous damping";
  static constexpr std::string_view reference = "standard linear dashpot";
  static constexpr std::string_view equations[] = {"F <- F + c v"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "c", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 0, .linear = true, .role = PhysicalRole::damping},
  };
  static constexpr std::string_view kin[] = {"quadratic-damping", "shear-thinning"};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::viscous, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::fluid,
      .in_words = "viscous damping",
      .shows = "a force in proportion to the velocity",
      .experiment = "constant-velocity runs over at least a decade of speed",
      .rig_cause = "a greased guide or bearing between the load cell and the damper",
      .one_form = true,
      .kin = kin,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [c] = p;
    return below + c * in.v;
  }
};

}  // namespace

extern const Part effect_viscous_damping;
constexpr Part effect_viscous_damping = compile<ViscousDamping>();

}  // namespace hysteron
