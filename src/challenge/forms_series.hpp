// In series with the damper: play, springs, gas pockets, dashpots, cavities. The force balance is solved for the speed
// of the damper (physics.cpp); `stretch` is the rod's displacement less the damper's.
#pragma once

#include <algorithm>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// A force that follows from the stretch alone.
struct ElasticElement : Part {
  [[nodiscard]] InSeries chain() const final { return InSeries::elastic; }
  [[nodiscard]] virtual double pull(double stretch) const = 0;
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double) const final {
    return pull(stretch);
  }
};

// clearance/damped-contact: F = sgn(y) (k p + c p')+,  p = |y| - g / 2 > 0: hard contact that does not pull.
// Source: elasto-gap of the Modelica standard library.
struct DampedContact final : Part {
  double gap = 0.0, stiffness = 1e6, damping = 1e3;
  DampedContact(double g, double k, double c) : gap(g), stiffness(k), damping(c) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double rate) const override {
    const double press = std::abs(stretch) - 0.5 * gap;
    if (press <= 0.0) return 0.0;
    const double side = stretch < 0.0 ? -1.0 : 1.0;
    return side * std::max(stiffness * press + damping * side * rate, 0.0);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"gap", gap, "m"}}; }
};

// clearance/hertz: F = f (p / d)^1.5,  p = |y| - g / 2: soft contact of round parts. Source: Hertz 1882.
struct HertzContact final : ElasticElement {
  double gap = 0.0, force = 1e3, depth = 1e-4;
  HertzContact(double g, double f, double d) : gap(g), force(f), depth(d) {}
  [[nodiscard]] double pull(double y) const override {
    const double press = std::max(std::abs(y) - 0.5 * gap, 0.0) / depth;
    return std::copysign(force * press * std::sqrt(press), y);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"gap", gap, "m"}}; }
};

// clearance/off-centre: F = k (y - q g)+ - k (-y - (1 - q) g)+: the test begins at the place q of the play.
// Source: dead zone with contact stiffness, standard.
struct OffCentreContact final : ElasticElement {
  double gap = 0.0, stiffness = 1e6, place = 0.2;
  OffCentreContact(double g, double k, double q) : gap(g), stiffness(k), place(q) {}
  [[nodiscard]] double pull(double y) const override {
    return stiffness * (std::max(y - place * gap, 0.0) - std::max(-y - (1.0 - place) * gap, 0.0));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"gap", gap, "m"}}; }
};

// clearance/rubbing: F = f tanh(y' / v_f) + k (|y| - g / 2)+ sgn y: friction in the gap. Source: standard.
struct RubbingContact final : Part {
  double gap = 0.0, stiffness = 1e6, friction = 0.0, film = 1e-3;
  RubbingContact(double g, double k, double f, double v_f) : gap(g), stiffness(k), friction(f), film(v_f) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double rate) const override {
    const double press = std::max(std::abs(stretch) - 0.5 * gap, 0.0);
    return friction * std::tanh(rate / film) + std::copysign(stiffness * press, stretch);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"gap", gap, "m"}}; }
};

// compliance/hardening: F = k y (1 + (y / y_0)^2). Source: standard (Duffing).
struct HardeningCompliance final : ElasticElement {
  double stiffness = 1e6, length = 1e-3;
  HardeningCompliance(double k, double y_0) : stiffness(k), length(y_0) {}
  [[nodiscard]] double pull(double y) const override {
    const double part = y / length;
    return stiffness * y * (1.0 + part * part);
  }
};

// compliance/aerated-oil: F = k d sgn(y) (exp(|y| / d) - 1): the bulk modulus rises with the pressure.
// Source: tangent modulus in proportion to pressure, Merritt, Hydraulic Control Systems, Wiley 1967, section 2. It is
// the air in the oil that does so: entrapped gas is a right name, too.
struct AeratedOil final : ElasticElement {
  double stiffness = 1e6, length = 1e-3;
  AeratedOil(double k, double d) : stiffness(k), length(d) {}
  [[nodiscard]] double pull(double y) const override {
    return std::copysign(stiffness * length * std::expm1(std::min(std::abs(y) / length, 30.0)), y);
  }
};

// compliance/kelvin-voigt: F = k (y + T y'). Source: Kelvin, Voigt.
struct KelvinVoigtCompliance final : Part {
  double stiffness = 1e6, time = 0.005;
  KelvinVoigtCompliance(double k, double T) : stiffness(k), time(T) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double rate) const override {
    return stiffness * (stretch + time * rate);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"C", 1.0 / stiffness, "m/N"}}; }
};

// compliance/standard-solid: F = k (y + a u),  u' = y' - u / T. Source: Zener, Elasticity and Anelasticity, 1948.
struct StandardSolidCompliance final : Part {
  double stiffness = 1e6, share = 0.5, time = 0.05;
  StandardSolidCompliance(double k, double a, double T) : stiffness(k), share(a), time(T) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale& scale, double* s) const override { s[0] = 0.1 * scale.length; }
  void rate(const Moment& m, const double* s, double* d) const override { d[0] = m.stretch_rate - s[0] / time; }
  [[nodiscard]] double series(const Moment&, const double* s, double stretch, double) const override {
    return stiffness * (stretch + share * s[0]);
  }
};

// A pocket of gas of length L under the pressure force P: F = P ((1 - |y| / L)^-kappa - 1), the same both ways.
inline double pocket_force(double y, double L, double P, double kappa) {
  const double left = std::max(1.0 - std::abs(y) / L, 0.02);
  return std::copysign(P * (std::pow(left, -kappa) - 1.0), y);
}

// entrapped-gas/isothermal: pocket_force with kappa = 1. Source: Boyle's law.
struct IsothermalPocket final : ElasticElement {
  double length = 1e-3, force = 50.0;
  IsothermalPocket(double L, double P) : length(L), force(P) {}
  [[nodiscard]] double pull(double y) const override { return pocket_force(y, length, force, 1.0); }
};

// entrapped-gas/adiabatic: pocket_force with kappa = 1.4. Source: Poisson's law.
struct AdiabaticPocket final : ElasticElement {
  double length = 1e-3, force = 50.0;
  AdiabaticPocket(double L, double P) : length(L), force(P) {}
  [[nodiscard]] double pull(double y) const override { return pocket_force(y, length, force, 1.4); }
};

// entrapped-gas/one-chamber: the pocket gives way to one sense of the force only; to the other the column is stiff.
// Source: Boyle's law in one chamber.
struct OneChamberPocket final : ElasticElement {
  double length = 1e-3, force = 50.0, stiffness = 1e7, side = 1.0;
  OneChamberPocket(double L, double P, double k, double sense) : length(L), force(P), stiffness(k), side(sense) {}
  [[nodiscard]] double pull(double y) const override {
    return side * y > 0.0 ? pocket_force(y, length, force, 1.0) : stiffness * y;
  }
};

// entrapped-gas/dissolving: isothermal pocket whose gas goes into solution under pressure: L n in place of L,
// n' = (1 / (1 + H |F| / P) - n) / T. Source: Henry's law with a first-order rate.
struct DissolvingPocket final : Part {
  double length = 1e-3, force = 50.0, solubility = 0.02, time = 0.5;
  DissolvingPocket(double L, double P, double H, double T) : length(L), force(P), solubility(H), time(T) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void start(const Moment&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = (1.0 / (1.0 + solubility * std::abs(m.core) / force) - s[0]) / time;
  }
  [[nodiscard]] double series(const Moment&, const double* s, double stretch, double) const override {
    return pocket_force(stretch, length * s[0], force, 1.0);
  }
};

// series-dashpot/orifice: y' = V |F / f|^0.6 sgn F: a leak past the piston that is nearly turbulent.
// Source: orifice flow between laminar (power 1) and turbulent (1/2).
struct OrificeLeak final : Part {
  double speed = 1e-2, force = 1e3;
  OrificeLeak(double V, double f) : speed(V), force(f) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::dashpot; }
  [[nodiscard]] double creep(double f) const override {
    return std::copysign(speed * std::pow(std::abs(f) / force, 0.6), f);
  }
  [[nodiscard]] double series(const Moment&, const double*, double, double rate) const override {
    return std::copysign(force * std::pow(std::abs(rate) / speed, 1.0 / 0.6), rate);
  }
};

// series-dashpot/check: y' = F / c, c larger by r where F < 0: the leak passes a check valve.
// Source: linear dashpot with two constants.
struct CheckedLeak final : Part {
  double drag = 1e5, ratio = 1.5;
  CheckedLeak(double c, double r) : drag(c), ratio(r) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::dashpot; }
  [[nodiscard]] double creep(double f) const override { return f < 0.0 ? f / (drag * ratio) : f / drag; }
  [[nodiscard]] double series(const Moment&, const double*, double, double rate) const override {
    return rate < 0.0 ? rate * drag * ratio : rate * drag;
  }
};

// series-dashpot/returning: F = c y' + k y, k so soft that the return takes seconds. Source: Kelvin, Voigt, in series.
struct ReturningLeak final : Part {
  double drag = 1e5, stiffness = 1e3;
  ReturningLeak(double c, double k) : drag(c), stiffness(k) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double rate) const override {
    return drag * rate + stiffness * stretch;
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"e", 1.0 / drag, "m/(N s)"}}; }
};

// cavitation/parted-column: y > 0: F = k y; y < 0: F = -min(k |y|, F_c (1 - tanh(y' / v_f)) / 2): the column parts at
// -F_c and closes again without force. Source: one-sided limit with a void, standard.
struct PartedColumn final : Part {
  double limit = 1e3, stiffness = 1e7, film = 1e-3;
  PartedColumn(double F_c, double k, double v_f) : limit(F_c), stiffness(k), film(v_f) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double stretch, double rate) const override {
    if (stretch >= 0.0) return stiffness * stretch;
    return -std::min(-stiffness * stretch, 0.5 * limit * (1.0 - std::tanh(rate / film)));
  }
};

// cavitation/vacuum: y > 0: F = F_c y / L; y < 0: F = -F_c |y| / (L + |y|): gas comes out of solution and widens at
// falling pressure, which cannot fall below none. Source: Boyle's law of a bubble under ambient pressure.
struct VacuumColumn final : ElasticElement {
  double limit = 1e3, length = 1e-4;
  VacuumColumn(double F_c, double L) : limit(F_c), length(L) {}
  [[nodiscard]] double pull(double y) const override {
    return y >= 0.0 ? limit * y / length : limit * y / (length - y);
  }
};

// cavitation/choked: F < 0: F / (1 + (|F| / F_c)^p)^(1/p): the suction saturates, without a void.
// Source: choked flow, as a smooth limit.
struct ChokedSuction final : Part {
  double limit = 1e3, power = 6.0;
  ChokedSuction(double F_c, double p) : limit(F_c), power(p) {}
  [[nodiscard]] double whole(const Moment&, const double*, double, double f) const override {
    return f >= 0.0 ? f : f / std::pow(1.0 + std::pow(-f / limit, power), 1.0 / power);
  }
};

}  // namespace hysteron::challenge
