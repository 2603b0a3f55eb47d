// Moving mass: rod, fluid or fixture between damper and load cell.
//   F <- F + m a
// a is the slope of the recorded velocity, smoothed as its noise asks for (io/velocity.hpp). Source: Newton's second
// law.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Inertia {
  static constexpr std::string_view id = "inertia";
  static constexpr std::string_view title = "Inertia of fluid, rod or fixture";
  static constexpr std::string_view reference = "Newton";
  static constexpr std::string_view equations[] = {"F <- F + m a"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {"m", "m", "kg", "effective mass", 0.0, 1.0e2, 0.0, Scale::linear, {1, 1, -2}, true},
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const T& m = p[0];
    return fma(m, in.a, below);
  }
};

}  // namespace

extern const Part effect_inertia;
constexpr Part effect_inertia = compile<Inertia>();

}  // namespace hysteron
