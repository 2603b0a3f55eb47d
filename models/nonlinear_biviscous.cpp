// Nonlinear biviscous: a steep viscous branch below the yield speed, a flat one with a yield force above it.
//   F = c_pr v              |v| <= v_y        c_pr = c0 + fy / v_y
//   F = c0 v + fy sgn(v)    |v| >  v_y
// written as F = c0 v + fy clamp(v / v_y, -1, 1) + f0, which is continuous by construction.
// Source: Stanway, Sproston, El-Wahed 1996, doi 10.1088/0964-1726/5/4/011; Wereley, Pang, Kamath 1998,
// doi 10.1177/1045389X9800900810.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct NonlinearBiviscous {
  static constexpr std::string_view id = "nonlinear-biviscous";
  static constexpr std::string_view title = "Nonlinear biviscous";
  static constexpr std::string_view reference =
      "Stanway, Sproston, El-Wahed, Smart Mater. Struct. 5 (1996) 464-482, doi 10.1088/0964-1726/5/4/011";
  static constexpr std::string_view equations[] = {"F = c0 v + fy clamp(v / v_y, -1, 1) + f0",
                                                   "pre-yield damping c_pr = c0 + fy / v_y"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "fy", .symbol = "f_y", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c0", .symbol = "c_po", .unit = "N s/m", .meaning = "post-yield damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      cards::f0,
      {.name = "v_y", .unit = "m/s", .meaning = "yield speed", .box = {1e-3, 0.25}, .initial = 0.03, .scale = Scale::logarithmic},
  };

  template <class T>
  static T force(const std::array<T, 4>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [fy, c0, f0, v_y] = p;
    return c0 * in.v + fy * max(min(in.v / v_y, T(1.0)), T(-1.0)) + f0;
  }
};

}  // namespace

extern const Part model_nonlinear_biviscous;
constexpr Part model_nonlinear_biviscous = compile<NonlinearBiviscous>();

}  // namespace hysteron
