// The force falls for good with the work done, as of wear, leakage or fluid breakdown.
//   F <- F / (1 + d s),   s' = |v|
// s is the travelled distance: the dissipated energy of a force of constant size (the force of the law is not known to
// the states of an effect). Unlike self-heating it does not recover. d is not linear together with the forces of the
// law.
// Source: the strength degradation 1 / nu of Baber, Noori, J. Eng. Mech. 111 (1985) 1010-1026, applied to the
// whole force.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Degradation {
  static constexpr std::string_view id = "degradation";
  static constexpr std::string_view title = "Degradation";
  static constexpr std::string_view reference = "loss of force over accumulated work; travel as its measure";
  static constexpr std::string_view equations[] = {"F <- F / (1 + d s)", "s' = |v|"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {"d", "d", "1/m", "relative loss of force per travelled distance", 0.0, 1.0, 0.0, Scale::linear, {0, -1, 0}},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 1>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return {abs(in.v)};
  }
  template <class T>
  static T stiffness(const std::array<T, 1>& /*p*/, double /*speed*/) {
    return T(0.0);
  }
  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    const T& d = p[0];
    return below / (T(1.0) + d * s[0]);
  }
};

}  // namespace

extern const Part effect_degradation;
constexpr Part effect_degradation = compile<Degradation>();

}  // namespace hysteron
