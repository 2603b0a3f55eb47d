// BingMax: Coulomb friction parallel to a Maxwell element, whose damping sets in with the relaxation time.
//   F  = fc tanh(v / v_s) + c0 h + f0
//   h' = (v - h) / lambda
// The source writes K int exp(-(t - s) / lambda) v(s) ds + F_y sgn(v), lambda = C / K: h is the velocity of the dashpot,
// c0 = C, and lambda stands in place of the spring K = c0 / lambda, so that c0 enters the force linearly. sgn(v) is
// rounded as in bingham, which this is for lambda -> 0.
// Source: Makris, Burton, Taylor, Smart Mater. Struct. 5 (1996) 551-564, in the form of Butz, von Stryk, ZAMM 82 (2002)
// 3-20. Neither was at hand when this was written: check the formula against them before relying on it.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct BinghamMaxwell {
  static constexpr std::string_view id = "bingham-maxwell";
  static constexpr std::string_view title = "BingMax: Coulomb friction and Maxwell element";
  static constexpr std::string_view reference = "Makris, Burton, Taylor, Smart Mater. Struct. 5 (1996) 551-564";
  static constexpr std::string_view equations[] = {"F = fc tanh(v / v_s) + c0 h + f0", "h' = (v - h) / lambda"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "fc", .symbol = "F_y", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c0", .symbol = "C", .unit = "N s/m", .meaning = "damping of the Maxwell element", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      cards::f0,
      {.name = "lambda", .unit = "s", .meaning = "relaxation time of the Maxwell element, C / K", .box = {5e-4, 0.1}, .initial = 5e-3, .scale = Scale::logarithmic},
      cards::v_s,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [fc, c0, f0, lambda, v_s] = p;
    const auto& [h] = s;
    return {(in.v - h) / lambda};
  }
  template <class T>
  static T stiffness(const std::array<T, 5>& p, double /*speed*/) {
    const auto& [fc, c0, f0, lambda, v_s] = p;
    return T(1.0) / lambda;
  }
  template <class T>
  static T force(const std::array<T, 5>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [fc, c0, f0, lambda, v_s] = p;
    const auto& [h] = s;
    return fc * tanh(in.v / v_s) + c0 * h + f0;
  }
};

}  // namespace

extern const Part model_bingham_maxwell;
constexpr Part model_bingham_maxwell = compile<BinghamMaxwell>();

}  // namespace hysteron
