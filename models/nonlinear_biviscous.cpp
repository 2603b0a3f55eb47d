// Nonlinear biviscous: a steep viscous branch below the yield speed, a flat one with a yield force above it.
//   F = c_pr v              |v| <= v_y        c_pr = c0 + fy / v_y
//   F = c0 v + fy sgn(v)    |v| >  v_y
// written as F = c0 v + fy clamp(v / v_y, -1, 1) + f0, which is continuous by construction.
// Source: Stanway, Sproston, El-Wahed 1996, doi 10.1088/0964-1726/5/4/011; Wereley, Pang, Kamath 1998,
// doi 10.1177/1045389X9800900810.
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
      as_yield_force({"fy", "f_y", "N", "yield force", 0.0, 3.0e3, 5.0e2, Scale::linear, {1, 0, 0}, true}),
      as_damping({"c0", "c_po", "N s/m", "post-yield damping", 0.0, 2.0e4, 5.0e2, Scale::linear, {1, 0, -1}, true}),
      as_offset_force({"f0", "f0", "N", "offset force", -1.5e3, 1.5e3, 0.0, Scale::linear, {1, 0, 0}, true}),
      {"v_y", "v_y", "m/s", "yield speed", 1.0e-3, 2.5e-1, 3.0e-2, Scale::logarithmic, {0, 0, 1}},
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
