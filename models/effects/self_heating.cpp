// The damper warms up as it works and its force falls.
//   F <- F exp(-b q),   q' = |v| - q / tau
// q stands for the excess temperature: the heat of a force of constant size over the travelled distance, lost with the
// thermal time constant tau. The force of the law is not known to the states of an effect, so the dissipated power F v
// enters by |v| with the mean force in b. It acts on all of the force below, so b is not linear together with the
// forces of the law.
// Source: exponential temperature law of viscosity, F ~ exp(-b (T - T0)).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SelfHeating {
  static constexpr std::string_view id = "self-heating";
  static constexpr std::string_view title = "Self-heating";
  static constexpr std::string_view reference = "exponential viscosity law; travel as the measure of heat";
  static constexpr std::string_view equations[] = {"F <- F exp(-b q)", "q' = |v| - q / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {"b", "b", "1/m", "relative loss of force per travelled distance", 0.0, 1.0, 0.0, Scale::linear, {0, -1, 0}},
      {"tau", "tau", "s", "thermal time constant", 1.0, 2.0e3, 6.0e1, Scale::logarithmic, {}},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const T& tau = p[1];
    return {abs(in.v) - s[0] / tau};
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
