// The damper warms up as it works and its force falls.
//   F <- F exp(-b q),   q' = F v - q / tau
// q is the heat stored above the surroundings: the power of the warm damper, lost with the thermal time constant tau. b
// is the relative loss of force per kelvin over the heat capacity. It acts on all of the force below, so nothing below
// is linear.
// Source: exponential temperature law of viscosity, F ~ exp(-b (T - T0)).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SelfHeating {
  static constexpr std::string_view id = "self-heating";
  static constexpr std::string_view title = "Self-heating";
  static constexpr std::string_view reference = "exponential viscosity law, first-order heat balance";
  static constexpr std::string_view equations[] = {"F <- F exp(-b q)", "q' = F v - q / tau"};
  static constexpr int states = 1;
  static constexpr bool has_loaded_rate = true;
  static constexpr Parameter parameters[] = {
      {"b", "b", "1/J", "relative loss of force per stored heat", 0.0, 2.0e-3, 0.0, Scale::linear, {-1, -1, 0}},
      {"tau", "tau", "s", "thermal time constant", 1.0, 2.0e3, 6.0e1, Scale::logarithmic, {}},
  };

  template <class T>
  static std::array<T, 1> loaded_rate(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in,
                                      const T& below) {
    const T& b = p[0];
    const T& tau = p[1];
    return {below * exp(-b * s[0]) * in.v - s[0] / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& p, double /*speed*/) {
    const T& tau = p[1];
    return T(1.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& /*in*/, const T& below) {
    const T& b = p[0];
    return below * exp(-b * s[0]);
  }
};

}  // namespace

extern const Part effect_self_heating;
constexpr Part effect_self_heating = compile<SelfHeating>();

}  // namespace hysteron
