// Dry friction of constant size in parallel.
//   F <- F + fc tanh(v / v_s),   v_s = 1 mm/s in place of sgn(v)
// Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct CoulombFriction {
  static constexpr std::string_view id = "coulomb-friction";
  static constexpr std::string_view title = "Coulomb friction";
  static constexpr std::string_view reference = "standard dry friction";
  static constexpr std::string_view equations[] = {"F <- F + fc tanh(v / v_s)"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {"fc", "f_c", "N", "friction force", 0.0, 1.0e3, 0.0, Scale::linear, {1, 0, 0}, true},
      {"v_s",
       "v_s",
       "m/s",
       "speed at which the sign function is rounded",
       1.0e-4,
       1.0e-1,
       1.0e-3,
       Scale::logarithmic,
       {0, 0, 1},
       false,
       true},
  };

  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const T& fc = p[0];
    const T& v_s = p[1];
    return below + fc * tanh(in.v / v_s);
  }
};

}  // namespace

extern const Part effect_coulomb_friction;
constexpr Part effect_coulomb_friction = compile<CoulombFriction>();

}  // namespace hysteron
