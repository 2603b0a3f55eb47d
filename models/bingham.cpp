// Bingham: Coulomb element parallel to a dashpot.
//   F = fc sgn(v) + c0 v + f0
// with sgn(v) replaced by tanh(v / v_s), v_s = 1 mm/s, so that the force is a function of velocity at rest too.
// Source: Stanway, Sproston, Stevens 1987, doi 10.1016/0304-3886(87)90056-8.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Bingham {
  static constexpr std::string_view id = "bingham";
  static constexpr std::string_view title = "Bingham: Coulomb friction and dashpot";
  static constexpr std::string_view reference =
      "Stanway, Sproston, Stevens, J. Electrostatics 20 (1987) 167-184, doi 10.1016/0304-3886(87)90056-8";
  static constexpr std::string_view equations[] = {"F = fc tanh(v / v_s) + c0 v + f0"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "fc", .symbol = "f_c", .unit = "N", .meaning = "yield force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      cards::c0,
      cards::f0,
      cards::v_s,
  };

  template <class T>
  static T force(const std::array<T, 4>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [fc, c0, f0, v_s] = p;
    return fc * tanh(in.v / v_s) + c0 * in.v + f0;
  }
};

}  // namespace

extern const Part model_bingham;
constexpr Part model_bingham = compile<Bingham>();

}  // namespace hysteron
