// Yield force with hysteresis in the field: Preisach operator of the drive, in front of a Bingham element.
//   F  = (f_y + f_i |y|) tanh(v / v_s) + c0 v + f0
//   y  = w_0 i + sum_j w_j b_j,   w_j proportional to exp(-d j / 4), sum w_j = 1,   j = 1 .. 4
//   b_j follows the drive i with play: i - r_j <= b_j <= i + r_j, moved by its edges only,   r_j = j R / 4
// A superposition of plays (Prandtl-Ishlinskii) is the Preisach operator whose density depends on the difference of the
// relays' thresholds alone: here a density on the four differences 2 r_j that decays with d. It has wiping-out and
// congruency, and no saturation. Deviations from the source: it fits a density over both thresholds from first-order
// reversal curves of the fluid's shear stress in a rheometer; a damper's recording holds no such curves, hence three
// parameters and a fixed grid, and a yield force in place of the stress.
// An edge pulls its play with the time constant tau = 2 ms (held), so that the operator is a set of differential
// equations; plays begin at 0, the demagnetised state. At a constant drive this is `bingham`.
// Source: Han, Choi, Wereley, J. Intell. Mater. Syst. Struct. 18 (2007) 973-981; Preisach operator: Mayergoyz,
// Mathematical Models of Hysteresis, Springer 1991.
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Preisach {
  static constexpr std::string_view id = "preisach";
  static constexpr std::string_view title =
      "Preisach hysteresis of the yield force in the field (Prandtl-Ishlinskii density)";
  static constexpr std::string_view reference =
      "Han, Choi, Wereley, J. Intell. Mater. Syst. Struct. 18 (2007) 973-981; operator: Mayergoyz, Mathematical Models "
      "of "
      "Hysteresis, 1991";
  static constexpr std::string_view equations[] = {
      "F = (f_y + f_i |y|) tanh(v / v_s) + c0 v + f0", "y = w_0 i + sum_j w_j b_j, w_j ~ exp(-d j / 4), sum w_j = 1",
      "b_j' = (max(i - r_j - b_j, 0) + min(i + r_j - b_j, 0)) / tau, r_j = j R / 4, j = 1 .. 4"};
  static constexpr int states = 4;
  static constexpr Parameter parameters[] = {
      {.name = "f_y", .unit = "N", .meaning = "yield force without field", .box = {0, 3e3}, .initial = 100, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "f_i", .unit = "N/A", .meaning = "growth of the yield force with the field", .box = {0, 6e3}, .initial = 500, .linear = true},
      cards::c0,
      cards::f0,
      {.name = "R", .unit = "A", .meaning = "half width of the widest relay", .box = {0.01, 0.5}, .initial = 0.1, .scale = Scale::logarithmic},
      {.name = "d", .unit = "1", .meaning = "decay of the density with the width of the relays", .box = {0, 8}, .initial = 1, .limits = {}},
      cards::v_s,
      {.name = "tau", .unit = "s", .meaning = "time constant of the plays", .box = {5e-4, 0.02}, .initial = 2e-3, .scale = Scale::logarithmic, .fixed = true},
  };

  // b' of a play of half width r.
  template <class T>
  static T pull(const T& r, const T& i, const T& b, const T& tau) {
    const T ahead = i - b;
    return (max(ahead - r, T(0.0)) + min(ahead + r, T(0.0))) / tau;
  }
  template <class T>
  static std::array<T, 4> rate(const std::array<T, 8>& p, const std::array<T, 4>& s, const Input<T>& in) {
    const auto& [f_y, f_i, c0, f0, R, d, v_s, tau] = p;
    const auto& [b_1, b_2, b_3, b_4] = s;
    const T& i = in.drive;
    return {pull(T(0.25) * R, i, b_1, tau), pull(T(0.5) * R, i, b_2, tau), pull(T(0.75) * R, i, b_3, tau),
            pull(T(1.0) * R, i, b_4, tau)};
  }
  template <class T>
  static T stiffness(const std::array<T, 8>& p, double /*speed*/) {
    const auto& [f_y, f_i, c0, f0, R, d, v_s, tau] = p;
    // Twice the bound: the edges are kinks no step lands on.
    return T(2.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 8>& p, const std::array<T, 4>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [f_y, f_i, c0, f0, R, d, v_s, tau] = p;
    T sum = in.drive;
    T total(1.0);
    const T ratio = exp(T(-0.25) * d);
    T weight = ratio;
    for (const T& b : s) {
      sum = sum + weight * b;
      total = total + weight;
      weight = weight * ratio;
    }
    return (f_y + f_i * abs(sum / total)) * tanh(in.v / v_s) + c0 * in.v + f0;
  }
};

}  // namespace

extern const Part model_preisach;
constexpr Part model_preisach = compile<Preisach>();

}  // namespace hysteron
