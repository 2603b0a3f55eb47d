// Quasi-static axisymmetric flow of a Bingham fluid through the annular gap of a damper: geometry and fluid in, force
// out.
//   F = (v / u) A_p (G L_a + G_p L_p) + f0,   u = sqrt(v^2 + v_s^2),   Q = A_p u
// In the gap R1 <= r <= R2 = R1 + h the pressure gradient G shears the fluid with tau(r) = -G r / 2 + C / r:
//   R1 <= r <= r1:  eta w' = tau - tau_y     (w the velocity, 0 at both walls)
//   r1 <= r <= r2:  plug, |tau| <= tau_y, so that r2 - r1 = 2 tau_y / G and C = G r1 r2 / 2
//   r2 <= r <= R2:  eta w' = tau + tau_y
// r1 and G follow from w(r1) = w(r2) and Q = 2 pi int w r dr by Newton's method, started at the plug of parallel
// plates, s^3 - (3/2 + q) s^2 + 1/2 = 0 with s = G h / (2 tau_y) and q = 3 eta Q / (pi R h^2 tau_y). Over the length
// L_p without field the fluid is Newtonian: G_p = 8 eta Q / (pi (R2^4 - R1^4 - (R2^2 - R1^2)^2 / ln(R2 / R1))). The
// walls are at rest: the flow dragged by the piston is neglected, as for A_p much larger than the gap. v_s rounds the
// change of sign; at v = 0 the force is zero and not the yield force.
// The force determines products only, so the geometry is held unless freed.
// Source: Yang, Spencer, Carlson, Sain, Eng. Struct. 24 (2002) 309-323, doi 10.1016/S0141-0296(01)00097-9.
#include <numbers>

#include "models/cards.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct QuasiStaticFlow {
  static constexpr std::string_view id = "quasi-static-flow";
  static constexpr std::string_view title = "Quasi-static flow of a Bingham fluid in an annular gap";
  static constexpr std::string_view reference =
      "Yang, Spencer, Carlson, Sain, Eng. Struct. 24 (2002) 309-323, doi 10.1016/S0141-0296(01)00097-9";
  static constexpr std::string_view equations[] = {
      "F = (v / u) A_p (G L_a + G_p L_p) + f0, u = sqrt(v^2 + v_s^2)",
      "2 pi int_R1^R2 w r dr = A_p u, w(R1) = w(R2) = 0, w(r1) = w(r2)",
      "eta w' = -G r / 2 + C / r -+ tau_y outside the plug r1 .. r2 = r1 + 2 tau_y / G, C = G r1 r2 / 2",
      "G_p = 8 eta A_p u / (pi (R2^4 - R1^4 - (R2^2 - R1^2)^2 / ln(R2 / R1)))"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "tau_y", .unit = "Pa", .meaning = "yield stress of the fluid in the field", .box = {100, 6e4}, .initial = 1e4, .scale = Scale::logarithmic, .dimension = {.force = 1}},
      {.name = "eta", .unit = "Pa s", .meaning = "plastic viscosity", .box = {0.01, 3}, .initial = 0.1, .scale = Scale::logarithmic, .dimension = {.force = 1, .velocity = -1}},
      cards::f0,
      {.name = "A_p", .unit = "m^2", .meaning = "piston area that displaces fluid", .box = {1e-4, 0.01}, .initial = 8e-4, .scale = Scale::logarithmic, .fixed = true},
      {.name = "R", .unit = "m", .meaning = "mean radius of the gap", .box = {5e-3, 0.1}, .initial = 0.015, .scale = Scale::logarithmic, .fixed = true},
      {.name = "h", .unit = "m", .meaning = "height of the gap", .box = {3e-4, 2.5e-3}, .initial = 7e-4, .scale = Scale::logarithmic, .fixed = true},
      {.name = "L_a", .unit = "m", .meaning = "length of the gap in the field", .box = {2e-3, 0.2}, .initial = 0.02, .scale = Scale::logarithmic, .fixed = true},
      {.name = "L_p", .unit = "m", .meaning = "length of the gap without field", .box = {0, 0.2}, .initial = 0.02, .fixed = true},
      {.name = "v_s", .unit = "m/s", .meaning = "speed at which the change of sign is rounded", .box = {1e-4, 0.1}, .initial = 1e-3, .scale = Scale::logarithmic, .fixed = true},
  };

  // Pressure gradient over that at which the whole gap would be plug, for the dimensionless flow q and the gap k = h /
  // R.
  template <class T>
  static T gradient(const T& q, const T& k) {
    const T a = q + T(1.5);
    T s = T(1.0) + sqrt(T(2.0 / 3.0) * q) + q;
    for (int step = 0; step < 6; ++step) {
      s = s - ((s - a) * s * s + T(0.5)) / (s * (T(3.0) * s - T(2.0) * a));
    }
    // Radii over the mean radius.
    const T inner = T(1.0) - T(0.5) * k;
    const T outer = T(1.0) + T(0.5) * k;
    const T flow = q * k * k * k * T(1.0 / 6.0);
    T r1 = T(1.0) - T(0.5) * k / s;
    for (int step = 0; step < 5; ++step) {
      const T t = T(0.5) * k / s;
      const T r2 = r1 + T(2.0) * t;
      const T c = T(0.5) * r1 * r2;
      const T below = r1 - inner;
      const T above = outer - r2;
      const T logs = log(r1 / inner) + log(outer / r2);
      const T below2 = below * (r1 + inner);
      const T above2 = above * (outer + r2);
      const T squares = below2 + above2;
      const T cubes = below * (r1 * r1 + r1 * inner + inner * inner) - above * (outer * outer + outer * r2 + r2 * r2);
      const T gap = c * logs - T(0.25) * squares - t * (below - above);
      const T w = T(0.125) * (below2 * (r1 * r1 + inner * inner) + above2 * (outer * outer + r2 * r2)) -
                  T(0.5) * c * squares + T(1.0 / 3.0) * t * cubes;
      const T gap_t = logs * r1 - (below - above);
      const T w_c = T(-0.5) * squares;
      const T w_t = T(1.0 / 3.0) * cubes + w_c * r1;
      const T j11 = logs * (r1 + t);
      const T j12 = -gap_t * t / s;
      const T j21 = s * w_c * (r1 + t);
      const T j22 = w - t * w_t;
      const T missing = s * w - flow;
      const T determinant = j11 * j22 - j12 * j21;
      r1 = r1 - (gap * j22 - j12 * missing) / determinant;
      s = s - (j11 * missing - j21 * gap) / determinant;
    }
    return s;
  }

  template <class T>
  static T force(const std::array<T, 9>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [tau_y, eta, f0, A_p, R, h, L_a, L_p, v_s] = p;
    const T u = sqrt(in.v * in.v + v_s * v_s);
    const T Q = A_p * u;
    const T plug_gradient = T(2.0) * tau_y / h;
    const T q = T(3.0 / std::numbers::pi) * eta * Q / (R * h * h * tau_y);
    const T k = h / R;
    const T inner = T(1.0) - T(0.5) * k;
    const T outer = T(1.0) + T(0.5) * k;
    const T inner2 = inner * inner;
    const T outer2 = outer * outer;
    const T difference = outer2 - inner2;
    const T annulus = difference * (outer2 + inner2 - difference / log(outer / inner));
    const T R2 = R * R;
    const T G_p = T(8.0 / std::numbers::pi) * eta * Q / (R2 * R2 * annulus);
    const T G = plug_gradient * gradient(q, k);
    return in.v / u * A_p * (G * L_a + G_p * L_p) + f0;
  }
};

}  // namespace

extern const Part model_quasi_static_flow;
constexpr Part model_quasi_static_flow = compile<QuasiStaticFlow>();

}  // namespace hysteron
