// Baber-Noori: Bouc-Wen whose strength and stiffness degrade with the dissipated energy and whose loop pinches.
//   F  = c0 v + k0 x + alpha z + f0
//   z' = h (v - nu |z|^n (share |v| sgn(z) + (1 - share) v)) / (eta x_y)
//   e' = z v                                  energy of the hysteresis per unit of alpha, m
//   D  = E (1 - exp(-max(e, 0) / E))          equals e until the degradation saturates at E
//   nu = 1 + delta_nu D,  eta = 1 + delta_eta D
//   h  = 1 - zeta_1 exp(-(z sgn(v) - q z_u)^2 / zeta_2^2),  z_u = nu^(-1/n)
//   zeta_1 = zeta_s (1 - exp(-p D)),  zeta_2 = (psi + delta_psi D) (lambda + zeta_1)
// Normal form of z, x_y and share as in bouc-wen; the degradation of A of the source is left out because it is the same
// as a change of nu, eta and alpha. The sources have D = e, unbounded; the saturation keeps the equations' stiffness,
// and so the number of steps, finite. With delta_nu = delta_eta = zeta_s = 0 the model is bouc-wen.
// Source: Baber,
// Noori, J. Eng. Mech. 111 (1985) 1010-1026, doi 10.1061/(ASCE)0733-9399(1985)111:8(1010); pinching function in the
// form of Foliente, J. Struct. Eng. 121 (1995) 1013-1022, doi 10.1061/(ASCE)0733-9445(1995)121:6(1013).
#include "models/bouc_wen.hpp"
#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct BaberNoori {
  static constexpr std::string_view id = "baber-noori";
  static constexpr std::string_view title = "Baber-Noori: degrading, pinching Bouc-Wen";
  static constexpr std::string_view reference =
      "Baber, Noori, J. Eng. Mech. 111 (1985) 1010-1026, doi 10.1061/(ASCE)0733-9399(1985)111:8(1010); Foliente, J. "
      "Struct. Eng. 121 (1995) 1013-1022, doi 10.1061/(ASCE)0733-9445(1995)121:6(1013)";
  static constexpr std::string_view equations[] = {
      "F = c0 v + k0 x + alpha z + f0",
      "z' = h (v - nu |z|^n (share |v| sgn(z) + (1 - share) v)) / (eta x_y)",
      "e' = z v, D = E (1 - exp(-max(e, 0) / E))",
      "nu = 1 + delta_nu D, eta = 1 + delta_eta D",
      "h = 1 - zeta_1 exp(-(z sgn(v) - q nu^(-1/n))^2 / zeta_2^2)",
      "zeta_1 = zeta_s (1 - exp(-p D)), zeta_2 = (psi + delta_psi D) (lambda + zeta_1)"};
  static constexpr int states = 2;
  static constexpr Parameter parameters[] = {
      {.name = "alpha", .unit = "N", .meaning = "yield force of the fresh hysteresis", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      cards::c0,
      cards::k0,
      {.name = "f0", .unit = "N", .meaning = "offset force, -k0 x0", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
      {.name = "x_y", .unit = "m", .meaning = "yield displacement", .box = {1e-4, 0.025}, .initial = 1e-3, .scale = Scale::logarithmic},
      {.name = "share", .symbol = "beta/(beta+gamma)", .unit = "1", .meaning = "share of the |v| z term: loop shape", .box = {0.1, 1.5}, .initial = 0.5},
      {.name = "n", .unit = "1", .meaning = "sharpness of the knee", .box = {1, 4}, .initial = 1.5},
      {.name = "delta_nu", .unit = "1/m", .meaning = "strength degradation per unit of energy over alpha", .box = {0, 0.5}, .initial = 0, .limits = {}},
      {.name = "delta_eta", .unit = "1/m", .meaning = "stiffness degradation per unit of energy over alpha", .box = {0, 2}, .initial = 0, .limits = {}},
      {.name = "zeta_s", .unit = "1", .meaning = "severity of the pinching when it is fully developed", .box = {0, 0.95}, .initial = 0, .limits = {.lower = 0, .upper = 1}},
      {.name = "q", .unit = "1", .meaning = "level of z, over its limit, where the loop pinches", .box = {0, 0.5}, .initial = 0.1},
      {.name = "p", .unit = "1/m", .meaning = "speed at which the pinching develops with energy over alpha", .box = {1, 1e3}, .initial = 50, .scale = Scale::logarithmic},
      {.name = "psi", .unit = "1", .meaning = "width of the pinching", .box = {0.15, 1}, .initial = 0.2, .scale = Scale::logarithmic},
      {.name = "delta_psi", .unit = "1/m", .meaning = "growth of that width per unit of energy over alpha", .box = {0, 1}, .initial = 0},
      {.name = "lambda", .unit = "1", .meaning = "coupling of width and severity of the pinching", .box = {0.05, 1}, .initial = 0.5, .scale = Scale::logarithmic},
      {.name = "E", .unit = "m", .meaning = "energy over alpha at which degradation saturates", .box = {1, 100}, .initial = 10, .scale = Scale::logarithmic, .fixed = true},
  };

  template <class T>
  static std::array<T, 2> rate(const std::array<T, 16>& card, const std::array<T, 2>& s, const Input<T>& in) {
    const auto& [alpha, c0, k0, f0, x_y, share, n, delta_nu, delta_eta, zeta_s, q, p, psi, delta_psi, lambda, E] = card;
    const auto& [z, e] = s;
    const T D = E * (T(1.0) - exp(-max(e, T(0.0)) / E));
    const T nu = T(1.0) + delta_nu * D;
    const T eta = T(1.0) + delta_eta * D;
    const T zeta_1 = zeta_s * (T(1.0) - exp(-p * D));
    const T zeta_2 = (psi + delta_psi * D) * (lambda + zeta_1);
    const T forward = select(in.v < T(0.0), -z, z);  // z sgn(v)
    const T distance = (forward - q * pow(nu, T(-1.0) / n)) / zeta_2;
    const T h = T(1.0) - zeta_1 * exp(-distance * distance);
    return {h * (in.v - nu * power_law(abs(z), n) * against(share, z, in.v)) / (eta * x_y), z * in.v};
  }
  // |z'| <= (1 + steepest) |v| / x_y; |dh / dz| <= sqrt(2 / e) zeta_1 / zeta_2; the coupling of z and e by the
  // geometric mean of its two derivatives.
  template <class T>
  static T stiffness(const std::array<T, 16>& card, double speed) {
    const auto& [alpha, c0, k0, f0, x_y, share, n, delta_nu, delta_eta, zeta_s, q, p, psi, delta_psi, lambda, E] = card;
    const T steep = steepest(share);
    const T weakest = T(1.0) + delta_nu * E;
    const T slope = T(0.86) * zeta_s / ((lambda + zeta_s) * psi);
    const T whole = T(1.0) + steep;
    const T own = n * pow(weakest, T(1.0) / n) * steep + slope * whole;
    const T by_energy =
        steep * delta_nu + whole * (delta_eta + slope * q * delta_nu + zeta_s * (T(1.75) * p + delta_psi / psi));
    return T(speed) * (own / x_y + sqrt(by_energy / x_y));
  }
  template <class T>
  static T force(const std::array<T, 16>& card, const std::array<T, 2>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [alpha, c0, k0, f0, x_y, share, n, delta_nu, delta_eta, zeta_s, q, p, psi, delta_psi, lambda, E] = card;
    const auto& [z, e] = s;
    return c0 * in.v + k0 * in.x + alpha * z + f0;
  }
};

}  // namespace

extern const Part model_baber_noori;
constexpr Part model_baber_noori = compile<BaberNoori>();

}  // namespace hysteron
