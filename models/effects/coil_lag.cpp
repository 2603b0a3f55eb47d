// The current in the coil lags the recorded command, by inductance, driver and eddy currents.
//   F <- F (1 + g |i|) / (1 + g |i_cmd|)
//   i' = (i_cmd - i) / tau
// Parameters that depend on the current follow the recorded drive, so the force below is that of i_cmd; the factor
// turns a force proportional to 1 + g |i_cmd| into the one of the lagged current. Nothing changes while the current is
// constant, from the first sample on (models/motion_filter.hpp): the effect shows in recordings with a varying current
// only.
// Source: first-order lag of the drive as in Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct CoilLag {
  static constexpr std::string_view id = "coil-lag";
  static constexpr std::string_view title = "Lag of the coil current";
  static constexpr std::string_view reference =
      "Spencer et al., J. Eng. Mech. 123 (1997) 230-238; first-order drive lag";
  static constexpr std::string_view equations[] = {"F <- F (1 + g |i|) / (1 + g |i_cmd|)", "i' = (i_cmd - i) / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {"g",
       "g",
       "1/A",
       "growth of the force per unit of drive, over the force at zero drive",
       0.0,
       1.0e1,
       0.0,
       Scale::linear,
       {}},
      {"tau", "tau", "s", "time constant of the coil", 5.0e-4, 5.0e-1, 5.0e-3, Scale::logarithmic, {}},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const T& tau = p[1];
    return {(in.drive - s[0]) / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 2>& p, double /*speed*/) {
    const T& tau = p[1];
    return T(1.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 2>& p, const std::array<T, 1>& s, const Input<T>& in, const T& below) {
    const T& g = p[0];
    const T& tau = p[1];
    const T present = settled_lag(in.drive, s[0], tau, in.age);
    return below * (T(1.0) + g * abs(present)) / (T(1.0) + g * abs(in.drive));
  }
};

}  // namespace

extern const Part effect_coil_lag;
constexpr Part effect_coil_lag = compile<CoilLag>();

}  // namespace hysteron
