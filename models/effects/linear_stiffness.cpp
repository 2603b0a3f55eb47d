// A linear spring in parallel, as of a mount or of an accumulator over a short stroke.
//   F <- F + k x
// Source: standard.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct LinearStiffness {
  static constexpr std::string_view id = "linear-stiffness";
  static constexpr std::string_view title = "Linear stiffness";
  static constexpr std::string_view reference = "standard linear spring";
  static constexpr std::string_view equations[] = {"F <- F + k x"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {"k", "k", "N/m", "stiffness", -2.0e4, 1.0e5, 0.0, Scale::linear, {1, -1, 0}, true},
  };

  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const T& k = p[0];
    return below + k * in.x;
  }
};

}  // namespace

extern const Part effect_linear_stiffness;
constexpr Part effect_linear_stiffness = compile<LinearStiffness>();

}  // namespace hysteron
