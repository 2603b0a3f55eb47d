// Modified Bouc-Wen: the hysteresis, a spring k0 and a dashpot c0 in series with a dashpot c1, all parallel to k1.
//   F  = c1 y' + k1 (x - x0)
//   y' = (alpha z + c0 v + k0 (x - y)) / (c0 + c1)
//   z' = (u - |z|^n (share |u| sgn(z) + (1 - share) u)) / x_y,   u = v - y'
// marched in e = x - y, e' = u = (c1 v - k0 e - alpha z) / (c0 + c1), which needs no absolute position; e starts at 0.
// Normal form of z as in bouc-wen: Z = (A / (beta + gamma))^(1/n), alpha = alpha0 Z, x_y = Z / A and, in the notation
// of the source, where gamma multiplies |u| z, share = gamma / (beta + gamma). k0 < 0 lets e grow without bound, so the
// identification box starts at zero. Source: Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238,
// doi 10.1061/(ASCE)0733-9399(1997)123:3(230).
#include "models/bouc_wen.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct ModifiedBoucWen {
  static constexpr std::string_view id = "modified-bouc-wen";
  static constexpr std::string_view title = "Modified Bouc-Wen (Spencer)";
  static constexpr std::string_view reference =
      "Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238, doi 10.1061/(ASCE)0733-9399(1997)123:3(230)";
  static constexpr std::string_view equations[] = {
      "F = c1 y' + k1 (x - x0)", "y' = (alpha z + c0 v + k0 (x - y)) / (c0 + c1)",
      "z' = (u - |z|^n (share |u| sgn(z) + (1 - share) u)) / x_y, u = v - y'"};
  static constexpr int states = 2;
  static constexpr bool alternative = true;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .unit = "N", .meaning = "yield force: force of the saturated hysteresis", .box = {0, 3e3}, .initial = 500, .role = PhysicalRole::yield_force},
      {.name = "c0", .unit = "N s/m", .meaning = "viscous damping at high speed", .box = {0, 2e4}, .initial = 500, .role = PhysicalRole::damping},
      {.name = "c1", .unit = "N s/m", .meaning = "series dashpot: roll-off at low speed", .box = {2e3, 1e6}, .initial = 2e4, .scale = Scale::logarithmic, .role = PhysicalRole::damping},
      {.name = "k0", .unit = "N/m", .meaning = "stiffness at high speed", .box = {0, 1e5}, .initial = 1e3, .role = PhysicalRole::stiffness},
      {.name = "k1", .unit = "N/m", .meaning = "accumulator stiffness", .box = {-2e4, 1e5}, .initial = 0, .linear = true, .role = PhysicalRole::stiffness},
      {.name = "x_y", .unit = "m", .meaning = "yield displacement", .box = {1e-4, 0.025}, .initial = 1e-3, .scale = Scale::logarithmic},
      {.name = "share", .symbol = "gamma/(beta+gamma)", .unit = "1", .meaning = "share of the |u| z term: loop shape", .box = {0.1, 1.5}, .initial = 0.5},
      {.name = "n", .unit = "1", .meaning = "sharpness of the knee", .box = {1, 4}, .initial = 1.5},
      {.name = "x0", .unit = "m", .meaning = "initial deflection of the accumulator spring", .box = {-0.05, 0.05}, .initial = 0, .fixed = true},
  };

  template <class T>
  static T slip(const std::array<T, 9>& p, const std::array<T, 2>& s, const T& v) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    const auto& [e, z] = s;
    return (c1 * v - k0 * e - alpha * z) * (T(1.0) / (c0 + c1));
  }
  template <class T>
  static std::array<T, 2> rate(const std::array<T, 9>& p, const std::array<T, 2>& s, const Input<T>& in) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    const auto& [e, z] = s;
    const T u = slip(p, s, in.v);
    return {u, (u - power_law(abs(z), n) * against(share, z, u)) * (T(1.0) / x_y)};
  }
  static constexpr int settles = 1;
  template <class T>
  static T towards(const std::array<T, 9>& p, const std::array<T, 2>& s, const Input<T>& in) {
    return slip(p, s, in.v);
  }
  template <class T>
  static T slack(const std::array<T, 9>& p) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    return abs(k0) / (c0 + c1);
  }
  template <class T>
  static T stiffness(const std::array<T, 9>& p, double speed) {
    // One and a half times the bound: the slip changes sign between the reversals of v that steps land on.
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    return T(1.5) * stiffness_of_slip(p, T(speed), steepest(share));
  }
  // Spring and hysteresis only slow the slip, so that it grows no faster than the dashpots pass the acceleration on;
  // not so a spring that pushes on. The hysteresis loads while the slip keeps the sign of z.
  template <class T>
  static T stiffness_near(const std::array<T, 9>& p, const std::array<T, 2>& s, const T& v, double speed,
                          double change) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    const auto& [e, z] = s;
    const T u = slip(p, s, v);
    const T near = min(T(speed), abs(u) + c1 / (c0 + c1) * T(change));
    const T steep = select(z * u > T(0.0), T(1.0), steepest(share));
    return select(k0 < T(0.0), stiffness(p, speed), stiffness_of_slip(p, near, steep));
  }
  template <class T>
  static T stiffness_of_slip(const std::array<T, 9>& p, const T& u, const T& steep) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    const T series = c0 + c1;
    return (abs(k0) + abs(alpha) * (T(1.0) + steep) / x_y) / series + u * n * steep / x_y;
  }
  template <class T>
  static T force(const std::array<T, 9>& p, const std::array<T, 2>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, c1, k0, k1, x_y, share, n, x0] = p;
    return c1 * (in.v - slip(p, s, in.v)) + k1 * (in.x - x0);
  }
};

}  // namespace

extern const Part model_modified_bouc_wen;
constexpr Part model_modified_bouc_wen = compile<ModifiedBoucWen>();

}  // namespace hysteron
