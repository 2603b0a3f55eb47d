// Bouc-Wen hysteresis in parallel with a spring, a dashpot and an offset.
//   F  = c0 v + k0 x + alpha z + f0
//   z' = (v - |z|^n (share |v| sgn(z) + (1 - share) v)) / x_y
// Normal form: z is dimensionless and |z| <= 1, so the scale redundancy of the original is gone. With the parameters of
//   z0' = A v - beta |v| z0 |z0|^(n-1) - gamma v |z0|^n,   F = ... + alpha0 z0:
//   Z = (A / (beta + gamma))^(1/n), alpha = alpha0 Z, x_y = Z / A, share = beta / (beta + gamma);
// a displacement offset x0 of k0 (x - x0) is f0 = -k0 x0.
// Source: Wen, J. Eng. Mech. Div. 102 (1976) 249-263, doi 10.1061/JMCEA3.0002106.
#include "models/bouc_wen.hpp"

#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct BoucWen {
  static constexpr std::string_view id = "bouc-wen";
  static constexpr std::string_view title = "Bouc-Wen";
  static constexpr std::string_view reference =
      "Wen, J. Eng. Mech. Div. 102 (1976) 249-263, doi 10.1061/JMCEA3.0002106";
  static constexpr std::string_view equations[] = {"F = c0 v + k0 x + alpha z + f0",
                                                   "z' = (v - |z|^n (share |v| sgn(z) + (1 - share) v)) / x_y"};
  static constexpr int states = 1;
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .unit = "N", .meaning = "yield force: force of the saturated hysteresis", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      cards::c0,
      cards::k0,
      {.name = "f0", .unit = "N", .meaning = "offset force, -k0 x0", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
      {.name = "x_y", .unit = "m", .meaning = "yield displacement", .box = {5e-5, 0.025}, .initial = 1e-3, .scale = Scale::logarithmic},
      {.name = "share", .symbol = "beta/(beta+gamma)", .unit = "1", .meaning = "share of the |v| z term: loop shape, 0.5 gives straight unloading", .box = {0.1, 1.5}, .initial = 0.5},
      {.name = "n", .unit = "1", .meaning = "sharpness of the knee", .box = {1, 4}, .initial = 1.5},
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [alpha, c0, k0, f0, x_y, share, n] = p;
    const auto& [z] = s;
    return {(in.v - power_law(abs(z), n) * against(share, z, in.v)) * (T(1.0) / x_y)};
  }
  static constexpr int settles = 0;
  template <class T>
  static T towards(const std::array<T, 7>& /*p*/, const std::array<T, 1>& /*s*/, const Input<T>& in) {
    return in.v;
  }
  template <class T>
  static T stiffness(const std::array<T, 7>& p, double speed) {
    const auto& [alpha, c0, k0, f0, x_y, share, n] = p;
    return T(speed) * n * steepest(share) / x_y;
  }
  // The hysteresis loads while the velocity keeps the sign of z, and is then no steeper than its knee.
  template <class T>
  static T stiffness_near(const std::array<T, 7>& p, const std::array<T, 1>& s, const T& v, double speed,
                          double change) {
    const auto& [alpha, c0, k0, f0, x_y, share, n] = p;
    const auto& [z] = s;
    const T whole = stiffness(p, speed);
    return select(abs(v) > T(change), select(z * v > T(0.0), T(speed) * n / x_y, whole), whole);
  }
  template <class T>
  static T force(const std::array<T, 7>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, x_y, share, n] = p;
    const auto& [z] = s;
    return c0 * in.v + k0 * in.x + alpha * z + f0;
  }
};

}  // namespace

extern const Part model_bouc_wen;
constexpr Part model_bouc_wen = compile<BoucWen>();

}  // namespace hysteron
