// In the fluid: viscous and turbulent drag, thinning, asymmetry, pinching.
#pragma once

#include <algorithm>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// viscous-damping/eddy-drag: F = c v / (1 + (v / v_c)^2), v_c above the speeds of the test: a magnetic brake.
// Source: Wouterse, IEE Proc. B 138 (1991) 153-158.
struct EddyDrag final : Part {
  double drag = 0.0, speed = 1.0;
  EddyDrag(double c, double v_c) : drag(c), speed(v_c) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double v = m.rod.v / speed;
    return drag * m.rod.v / (1.0 + v * v);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"c", drag, "N s/m"}}; }
};

// viscous-damping/ambient: F = c (1 + e_r) v, e_r of test r drawn once: tests at other temperatures of the room.
// Source: Newtonian drag, standard.
struct AmbientDrag final : Part {
  double drag = 0.0;
  std::vector<double> scatter;
  AmbientDrag(double c, std::vector<double> e) : drag(c), scatter(std::move(e)) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return drag * (1.0 + scatter[m.test % scatter.size()]) * m.rod.v;
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"c", drag, "N s/m"}}; }
};

// viscous-damping/viscoelastic: F = c u,  u' = (v - u) / T: a dashpot on a stiff mount. Source: Maxwell element.
struct ViscoelasticDrag final : Part {
  double drag = 0.0, time = 0.004;
  ViscoelasticDrag(double c, double T) : drag(c), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale& scale, double* s) const override { s[0] = scale.speed; }
  void start(const Moment& m, double* s) const override { s[0] = m.rod.v; }
  void rate(const Moment& m, const double* s, double* d) const override { d[0] = (m.rod.v - s[0]) / time; }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return drag * s[0]; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"c", drag, "N s/m"}}; }
};

// quadratic-damping/turbulent: F = f sgn(v) |v / V|^1.75. Source: Blasius, friction of turbulent flow in smooth tubes.
struct TurbulentDrag final : Part {
  double force = 0.0, speed = 0.1;
  TurbulentDrag(double f, double V) : force(f), speed(V) {}
  [[nodiscard]] double fluid(const Moment&, const double*, double v) const override {
    return std::copysign(force * std::pow(std::abs(v) / speed, 1.75), v);
  }
};

// quadratic-damping/laminar-transition: F = f (v / V) sqrt((v / V)^2 + (v_t / V)^2): laminar below v_t.
// Source: Ellman, Vilenius, SAE 902049 (1990) (one formula through laminar and turbulent flow), in its smooth form.
struct TransitionDrag final : Part {
  double force = 0.0, speed = 0.1, turn = 0.03;
  TransitionDrag(double f, double V, double v_t) : force(f), speed(V), turn(v_t) {}
  [[nodiscard]] double fluid(const Moment&, const double*, double v) const override {
    return force * v / (speed * speed) * std::sqrt(v * v + turn * turn);
  }
};

// quadratic-damping/opening-shim: F = f v |v| / V^2 / (1 + |v| / v_b): an orifice whose shim bends open.
// Source: orifice equation with an area that grows with the flow.
struct ShimDrag final : Part {
  double force = 0.0, speed = 0.1, bend = 0.3;
  ShimDrag(double f, double V, double v_b) : force(f), speed(V), bend(v_b) {}
  [[nodiscard]] double fluid(const Moment&, const double*, double v) const override {
    return force * v * std::abs(v) / (speed * speed) / (1.0 + std::abs(v) / bend);
  }
};

// What of the viscous damping is left at a speed, c(v) = c (1 - l + l h(v)): h falls from 1 at rest to 0.
struct Thinning : Part {
  double loss = 0.0, speed = 0.1;
  Thinning(double l, double v_c) : loss(l), speed(v_c) {}
  [[nodiscard]] virtual double shape(double v_over_v_c) const = 0;
  [[nodiscard]] double damping(const Moment&, const double*, double v) const override {
    return 1.0 - loss + loss * shape(std::abs(v) / speed);
  }
};

// shear-thinning/power-law: h = min(1, r^(m - 1)), r = |v| / v_c. Source: Ostwald, de Waele, cut off at low shear.
struct PowerLawThinning final : Thinning {
  double index = 0.4;
  PowerLawThinning(double l, double v_c, double m) : Thinning(l, v_c), index(m) {}
  [[nodiscard]] double shape(double r) const override { return r <= 1.0 ? 1.0 : std::pow(r, index - 1.0); }
};

// shear-thinning/cross: h = 1 / (1 + r^m). Source: Cross, J. Colloid Sci. 20 (1965) 417-437.
struct CrossThinning final : Thinning {
  double power = 1.0;
  CrossThinning(double l, double v_c, double m) : Thinning(l, v_c), power(m) {}
  [[nodiscard]] double shape(double r) const override { return 1.0 / (1.0 + std::pow(r, power)); }
};

// shear-thinning/carreau-yasuda: h = (1 + r^a)^((m - 1) / a), a away from 2.
// Source: Yasuda, Armstrong, Cohen, Rheol. Acta 20 (1981) 163-178.
struct CarreauYasudaThinning final : Thinning {
  double index = 0.2, bend = 1.0;
  CarreauYasudaThinning(double l, double v_c, double m, double a) : Thinning(l, v_c), index(m), bend(a) {}
  [[nodiscard]] double shape(double r) const override {
    return std::pow(1.0 + std::pow(r, bend), (index - 1.0) / bend);
  }
};

// shear-thinning/papanastasiou: h = (1 - exp(-r)) / r: a plastic fluid without a sharp yield point.
// Source: Papanastasiou, J. Rheol. 31 (1987) 385-404.
struct PapanastasiouThinning final : Thinning {
  using Thinning::Thinning;
  [[nodiscard]] double shape(double r) const override { return r < 1e-8 ? 1.0 : -std::expm1(-r) / r; }
};

// shear-thinning/eyring: h = asinh(r) / r. Source: Powell, Eyring, Nature 154 (1944) 427-428.
struct EyringThinning final : Thinning {
  using Thinning::Thinning;
  [[nodiscard]] double shape(double r) const override { return r < 1e-8 ? 1.0 : std::asinh(r) / r; }
};

// asymmetry/damping: c (1 + e tanh(v / v_s)), v_s a few percent of the speed. Source: separate valves that take turns.
struct DampingAsymmetry final : Part {
  double difference = 0.0, film = 1e-2;
  DampingAsymmetry(double e, double v_s) : difference(e), film(v_s) {}
  [[nodiscard]] double damping(const Moment&, const double*, double v) const override {
    return 1.0 + difference * std::tanh(v / film);
  }
};

// asymmetry/yield: yield force times 1 + e b, b the branch of the hysteresis from -1 to 1. Source: standard.
struct YieldAsymmetry final : Part {
  double difference = 0.0;
  explicit YieldAsymmetry(double e) : difference(e) {}
  [[nodiscard]] double yield(const Moment& m, const double*) const override { return 1.0 + difference * m.branch; }
};

// asymmetry/unequal: yield force times 1 + e b, damping times 1 + q e sgn v. Source: standard.
struct UnequalAsymmetry final : Part {
  double difference = 0.0, ratio = 0.5;
  UnequalAsymmetry(double e, double q) : difference(e), ratio(q) {}
  [[nodiscard]] double yield(const Moment& m, const double*) const override { return 1.0 + difference * m.branch; }
  [[nodiscard]] double damping(const Moment&, const double*, double v) const override {
    return 1.0 + (v < 0.0 ? -ratio : ratio) * difference;
  }
};

// asymmetry/smooth: F (1 + e tanh(v / v_s)), v_s a good part of the speed: valves that open gradually. Source:
// standard.
struct SmoothAsymmetry final : Part {
  double difference = 0.0, speed = 0.03;
  SmoothAsymmetry(double e, double v_s) : difference(e), speed(v_s) {}
  [[nodiscard]] double whole(const Moment&, const double*, double v, double f) const override {
    return f * (1.0 + difference * std::tanh(v / speed));
  }
};

// pinching/rational: F (1 - p / (1 + y^4)),  y = (x - x_p) / w. Source: no accepted form is known.
struct RationalPinch final : Part {
  double loss = 0.0, centre = 0.0, width = 1e-2;
  RationalPinch(double p, double x_p, double w) : loss(p), centre(x_p), width(w) {}
  [[nodiscard]] double whole(const Moment& m, const double*, double, double f) const override {
    const double y = (m.rod.x - centre) / width;
    return f * (1.0 - loss / (1.0 + y * y * y * y));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override {
    return {{"p", loss, "1"}, {"x_p", centre, "m"}};
  }
};

// pinching/one-sided: F (1 - p / (1 + exp((x_p - x) / w))): a bore that is wide beyond x_p. Source: logistic step.
struct OneSidedPinch final : Part {
  double loss = 0.0, place = 0.0, width = 1e-3;
  OneSidedPinch(double p, double x_p, double w) : loss(p), place(x_p), width(w) {}
  [[nodiscard]] double whole(const Moment& m, const double*, double, double f) const override {
    return f * (1.0 - loss / (1.0 + std::exp(std::clamp((place - m.rod.x) / width, -40.0, 40.0))));
  }
};

// pinching/groove: F (1 - p (1 + cos(pi y)) / 2) for |y| < 1,  y = (x - x_p) / w: a groove of finite length.
// Source: raised cosine.
struct GroovePinch final : Part {
  double loss = 0.0, centre = 0.0, width = 1e-2;
  GroovePinch(double p, double x_p, double w) : loss(p), centre(x_p), width(w) {}
  [[nodiscard]] double whole(const Moment& m, const double*, double, double f) const override {
    const double y = (m.rod.x - centre) / width;
    return std::abs(y) >= 1.0 ? f : f * (1.0 - 0.5 * loss * (1.0 + std::cos(3.1415926535897931 * y)));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override {
    return {{"p", loss, "1"}, {"x_p", centre, "m"}};
  }
};

}  // namespace hysteron::challenge
