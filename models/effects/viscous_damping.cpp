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
      {"c", "c", "N s/m", "viscous damping", 0.0, 2.0e4, 0.0, Scale::linear, {1, 0, -1}, true},
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const T& c = p[0];
    return below + c * in.v;
  }
};

}  // namespace

extern const Part effect_viscous_damping;
constexpr Part effect_viscous_damping = compile<ViscousDamping>();

}  // namespace hysteron
