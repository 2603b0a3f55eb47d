// Parallel to the rod: offsets, springs, gas, stops and masses.
#pragma once

#include <algorithm>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// offset-force/scattering-preload: F = f (1 + e_r), e_r of test r drawn once. Source: a preload that is set anew.
struct ScatteringPreload final : Part {
  double force = 0.0;
  std::vector<double> scatter;
  ScatteringPreload(double f, std::vector<double> e) : force(f), scatter(std::move(e)) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * (1.0 + scatter[m.test % scatter.size()]);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"f0", force, "N"}}; }
};

// offset-force/settling: F = f (1 - a (1 - exp(-t / T))), t >= 0: a preload or load cell that creeps after the start.
// Source: standard (exponential creep).
struct SettlingPreload final : Part {
  double force = 0.0, part = 0.1, time = 3.0;
  SettlingPreload(double f, double a, double T) : force(f), part(a), time(T) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * (1.0 + part * std::expm1(-std::max(m.t, 0.0) / time));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"f0", force, "N"}}; }
};

// offset-force/soft-spring: F = f (1 + (x - x_m) / L), L many strokes: the charge of a large accumulator.
// Source: standard (preloaded linear spring).
struct SoftSpringPreload final : Part {
  double force = 0.0, length = 1.0;
  SoftSpringPreload(double f, double L) : force(f), length(L) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * (1.0 + (m.rod.x - m.middle) / length);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"f0", force, "N"}}; }
};

// linear-stiffness/softening: F = k x (1 - (x / x_s)^2), x_s beyond the stroke. Source: standard (Duffing, softening).
struct SofteningSpring final : Part {
  double stiffness = 0.0, length = 1.0;
  SofteningSpring(double k, double x_s) : stiffness(k), length(x_s) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double place = m.rod.x / length;
    return stiffness * m.rod.x * (1.0 - place * place);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"k", stiffness, "N/m"}}; }
};

// linear-stiffness/elastomer: F = k (x + a y),  y' = v - y / T: a rubber mount. Source: standard linear solid (Zener).
struct ElastomerSpring final : Part {
  double stiffness = 0.0, share = 0.2, time = 0.1;
  ElastomerSpring(double k, double a, double T) : stiffness(k), share(a), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void rate(const Moment& m, const double* s, double* d) const override { d[0] = m.rod.v - s[0] / time; }
  [[nodiscard]] double beside(const Moment& m, const double* s) const override {
    return stiffness * (m.rod.x + share * s[0]);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"k", stiffness, "N/m"}}; }
};

// linear-stiffness/unequal: F = k x (1 + e sgn x). Source: standard (bilinear spring).
struct UnequalSpring final : Part {
  double stiffness = 0.0, difference = 0.1;
  UnequalSpring(double k, double e) : stiffness(k), difference(e) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return stiffness * (m.rod.x + difference * std::abs(m.rod.x));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"k", stiffness, "N/m"}}; }
};

// cubic-stiffness/sinh: F = f sinh(x / L). Source: Eyring-type hardening, standard.
struct SinhSpring final : Part {
  double force = 0.0, length = 1e-2;
  SinhSpring(double f, double L) : force(f), length(L) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * std::sinh(m.rod.x / length);
  }
};

// cubic-stiffness/tan: F = f tan(pi x / (2 L)), L beyond the stroke. Source: Mindlin, Bell Syst. Tech. J. 24 (1945)
// 353-461 (tangent elasticity).
struct TangentSpring final : Part {
  double force = 0.0, length = 1e-2;
  TangentSpring(double f, double L) : force(f), length(L) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * std::tan(1.5707963267948966 * std::clamp(m.rod.x / length, -0.97, 0.97));
  }
};

// cubic-stiffness/quintic: F = f ((1 - q) (x / A)^3 + q (x / A)^5). Source: standard (next term of an odd series).
struct QuinticSpring final : Part {
  double force = 0.0, length = 1e-2, quintic = 0.5;
  QuinticSpring(double f, double A, double q) : force(f), length(A), quintic(q) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double y = m.rod.x / length;
    return force * y * y * y * (1.0 - quintic + quintic * y * y);
  }
};

// gas-spring/heat-exchange: F = f p,  p' = -kappa p V' / V - (p - 1 / V) / T,  V = 1 - g x. Isothermal (p V = 1) for
// slow, adiabatic (p V^kappa = 1) for fast strokes. p and V over those of x = 0. Source: first law for a gas with a
// thermal time constant; Pourmovahed, Otis, J. Dyn. Syst. Meas. Control 112 (1990) 116-121.
struct HeatExchangingGas final : Part {
  double force = 0.0, swept = 1.0, exponent = 1.4, time = 0.5;
  HeatExchangingGas(double f, double g, double kappa, double T) : force(f), swept(g), exponent(kappa), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void start(const Moment& m, double* s) const override { s[0] = 1.0 / (1.0 - swept * m.rod.x); }
  void rate(const Moment& m, const double* s, double* d) const override {
    const double volume = 1.0 - swept * m.rod.x;
    d[0] = exponent * s[0] * swept * m.rod.v / volume - (s[0] - 1.0 / volume) / time;
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return force * s[0]; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"g", swept, "1/m"}}; }
};

// gas-spring/dissolved: F = f n / V,  n' = (1 - H (n / V - 1) - n) / T: isothermal, and gas goes into solution as the
// pressure rises. Source: Henry's law with a first-order rate.
struct DissolvedGas final : Part {
  double force = 0.0, swept = 1.0, solubility = 0.2, time = 1.0;
  DissolvedGas(double f, double g, double H, double T) : force(f), swept(g), solubility(H), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void start(const Moment& m, double* s) const override {
    s[0] = (1.0 + solubility) / (1.0 + solubility / (1.0 - swept * m.rod.x));
  }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = (1.0 - solubility * (s[0] / (1.0 - swept * m.rod.x) - 1.0) - s[0]) / time;
  }
  [[nodiscard]] double beside(const Moment& m, const double* s) const override {
    return force * s[0] / (1.0 - swept * m.rod.x);
  }
};

// gas-spring/one-sided: F = f / (1 - g (x - x_1)+): the floating piston rests on its stop below x_1.
// Source: Boyle's law with a stop.
struct OneSidedGas final : Part {
  double force = 0.0, swept = 1.0, from = 0.0;
  OneSidedGas(double f, double g, double x_1) : force(f), swept(g), from(x_1) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force / (1.0 - swept * std::max(m.rod.x - from, 0.0));
  }
};

// gas-spring/elastic-bag: F = f p,  p (1 - g x + B (p - 1)) = 1: isothermal in a bag that widens with the pressure.
// Source: Boyle's law with an elastic wall.
struct ElasticBagGas final : Part {
  double force = 0.0, swept = 1.0, widening = 0.2;
  ElasticBagGas(double f, double g, double B) : force(f), swept(g), widening(B) {}
  [[nodiscard]] double pressure(double x) const {
    const double b = 1.0 - swept * x - widening;
    return (std::sqrt(b * b + 4.0 * widening) - b) / (2.0 * widening);
  }
  [[nodiscard]] double beside(const Moment& m, const double*) const override { return force * pressure(m.rod.x); }
};

// Where the stops begin, measured from the zero of the recording; `past` is how far the rod is beyond, with its sign.
struct StopPlaces {
  double up = 1.0, low = 1.0;
  [[nodiscard]] double past(double x) const { return x > up ? x - up : x < -low ? x + low : 0.0; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const { return {{"x_up", up, "m"}, {"x_low", low, "m"}}; }
};

// end-stop/exponential: F = f sgn(y) (exp(|y| / d) - 1), y past the stop. Source: standard (rubber buffer).
struct ExponentialStop final : Part {
  StopPlaces places;
  double force = 0.0, depth = 1e-3;
  ExponentialStop(StopPlaces p, double f, double d) : places(p), force(f), depth(d) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double y = places.past(m.rod.x);
    return std::copysign(force * std::expm1(std::min(std::abs(y) / depth, 12.0)), y);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return places.parameters(); }
};

// end-stop/hunt-crossley: F = f sgn(y) (|y| / d)^1.5 (1 + l y' sgn y)+: contact with loss.
// Source: Hunt, Crossley, J. Appl. Mech. 42 (1975) 440-445.
struct LossyStop final : Part {
  StopPlaces places;
  double force = 0.0, depth = 1e-3, loss = 1.0;
  LossyStop(StopPlaces p, double f, double d, double l) : places(p), force(f), depth(d), loss(l) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double y = places.past(m.rod.x);
    const double side = y < 0.0 ? -1.0 : 1.0;
    return side * force * std::pow(std::abs(y) / depth, 1.5) * std::max(1.0 + loss * side * m.rod.v, 0.0);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return places.parameters(); }
};

// end-stop/closing: F = f sgn(y) (|y| / L) / (1 - |y| / L): foam that closes at L. Source: standard (densification).
struct ClosingStop final : Part {
  StopPlaces places;
  double force = 0.0, length = 1e-3;
  ClosingStop(StopPlaces p, double f, double L) : places(p), force(f), length(L) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double y = places.past(m.rod.x);
    const double part = std::min(std::abs(y) / length, 0.95);
    return std::copysign(force * part / (1.0 - part), y);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return places.parameters(); }
};

// inertia/of-place: F = m(x) a + m'(x) v^2 / 2,  m(x) = m (1 + b (x - x_m) / A): fluid moves along with the stroke.
// Source: Lagrange's equation of a mass that depends on the place.
struct MassOfPlace final : Part {
  double mass = 0.0, slope = 0.3, length = 1e-2;
  MassOfPlace(double m, double b, double A) : mass(m), slope(b), length(A) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double place = (m.rod.x - m.middle) / length;
    return mass * ((1.0 + slope * place) * m.rod.a + 0.5 * slope / length * m.rod.v * m.rod.v);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"m", mass, "kg"}}; }
};

// inertia/sprung-fixture: F = -m (w^2 e + 2 z w e'),  e'' = -a - w^2 e - 2 z w e': the mass hangs on a stiff fixture.
// Source: seismic mass, standard.
struct SprungMass final : Part {
  double mass = 0.0, omega = 300.0, damping = 0.2;
  SprungMass(double m, double w, double z) : mass(m), omega(w), damping(z) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  void scales(const Scale& scale, double* s) const override {
    s[0] = 0.1 * scale.length;
    s[1] = 0.1 * scale.length * omega;
  }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = s[1];
    d[1] = -m.rod.a - omega * omega * s[0] - 2.0 * damping * omega * s[1];
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override {
    return -mass * (omega * omega * s[0] + 2.0 * damping * omega * s[1]);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"m", mass, "kg"}}; }
};

// inertia/entrained: F = m (a + b (y_1 / T_1 + y_2 / T_2) / 2),  y_k' = a - y_k / T_k: more fluid is entrained the
// slower the motion. Source: Basset's history force with its kernel as two exponentials.
struct EntrainedMass final : Part {
  double mass = 0.0, entrained = 0.5, fast = 0.03, slow = 0.15;
  EntrainedMass(double m, double b, double T_1, double T_2) : mass(m), entrained(b), fast(T_1), slow(T_2) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  void scales(const Scale& scale, double* s) const override { s[0] = s[1] = scale.speed; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = m.rod.a - s[0] / fast;
    d[1] = m.rod.a - s[1] / slow;
  }
  [[nodiscard]] double beside(const Moment& m, const double* s) const override {
    return mass * (m.rod.a + 0.5 * entrained * (s[0] / fast + s[1] / slow));
  }
};

}  // namespace hysteron::challenge
