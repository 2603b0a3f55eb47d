// The damper warms up as it works and its force falls, the viscous part of it more than the yield force.
//   F <- (F - c_h v) exp(-y b q) + c_h v exp(-b q),   q' = F v - q / tau
// q is the heat stored above the surroundings: the power of the warm damper, lost with the thermal time constant tau. b
// is the relative loss of viscosity per kelvin over the heat capacity, y the share of it that the other forces lose,
// c_h the damping that thins. It acts on all of the force below, so nothing below is linear. Where the starts of the
// recordings are told, each begins with what is left of the heat of those before it,
//   q(0) = sum w exp(-t / tau),  w the work measured a time t before.
// Source: exponential temperature law of viscosity, c ~ exp(-b (T - T0)).
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct SelfHeating {
  static constexpr std::string_view id = "self-heating";
  static constexpr std::string_view title = "Self-heating";
  static constexpr std::string_view reference = "exponential viscosity law, first-order heat balance";
  static constexpr std::string_view equations[] = {"F <- (F - c_h v) exp(-y b q) + c_h v exp(-b q)",
                                                   "q' = F v - q / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "b", .unit = "1/J", .meaning = "relative loss of viscosity per stored heat", .box = {0, 2e-3}, .initial = 0},
      {.name = "tau", .unit = "s", .meaning = "thermal time constant", .box = {1, 2e3}, .initial = 60, .scale = Scale::logarithmic, .dimension = {}},
      {.name = "y", .unit = "1", .meaning = "loss of the other forces over that of the viscosity", .box = {0, 1}, .initial = 0.7},
      {.name = "c_h", .unit = "N s/m", .meaning = "damping that thins", .box = {0, 2e4}, .initial = 0, .role = PhysicalRole::damping},
  };
  static constexpr std::string_view kin[] = {"degradation", "stiction"};
  // No heat is lost during the test; yield force and viscosity fall alike, or only one of them falls.
  static constexpr BoxLimit ends_as[] = {{id, "tau", BoxEnd::upper},
                                         {id, "y", BoxEnd::lower},
                                         {id, "y", BoxEnd::upper},
                                         {id, "c_h", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::energy_fade, Sense::positive}, {ContrastKind::pause_recovery, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::slow_loss,
      .in_words = "self-heating",
      .shows = "the force falls as the damper warms up, its viscous part most, and comes back after a pause",
      .experiment = "a long run of constant severity, a pause, and the first recording again, each file with its start",
      .rig_cause = "[a supply that lets the current sink as it warms up, or ]a force channel whose gain sinks",
      .kin = kin,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static T warm(const std::array<T, 4>& p, const T& q, const Input<T>& in, const T& below) {
    const auto& [b, tau, y, c_h] = p;
    const T loss = b * q;
    const T viscous = c_h * in.v;
    return (below - viscous) * exp(-y * loss) + viscous * exp(-loss);
  }

  template <class T>
  static std::array<T, 1> begin(const std::array<T, 4>& p, std::span<const EarlierWork> earlier) {
    const auto& [b, tau, y, c_h] = p;
    return {left_of(earlier, T(1.0) / tau)};
  }
  template <class T>
  static std::array<T, 1> loaded_rate(const std::array<T, 4>& p, const std::array<T, 1>& s, const Input<T>& in,
                                      const T& below) {
    const auto& [b, tau, y, c_h] = p;
    const auto& [q] = s;
    return {warm(p, q, in, below) * in.v - q / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 4>& p, double /*speed*/) {
    const auto& [b, tau, y, c_h] = p;
    return T(1.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 4>& p, const std::array<T, 1>& s, const Input<T>& in, const T& below) {
    const auto& [q] = s;
    return warm(p, q, in, below);
  }
};

}  // namespace

extern const Part effect_self_heating;
constexpr Part effect_self_heating = compile<SelfHeating>();

}  // namespace hysteron
