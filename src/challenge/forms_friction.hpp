// Dry friction, friction of seals, and hysteresis before the yield point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// Parallel elastic-plastic elements of equal strength that begin to slip one after another, at deflections up to
// `knee`.
//   F = (f / N) sum s_k / d_k,   s_k' = v, 0 where |s_k| = d_k and v s_k > 0,   d_k = knee k / N
// Source: Iwan, J. Appl. Mech. 33 (1966) 893-900 (as Maxwell-slip in the friction literature).
template <std::size_t N>
struct SlipElements {
  double knee = 1e-4;

  [[nodiscard]] double limit(std::size_t k) const { return knee * static_cast<double>(k + 1) / N; }
  // The mean of s_k / d_k.
  [[nodiscard]] double engaged(const double* s) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < N; ++k) sum += std::clamp(s[k] / limit(k), -1.0, 1.0);
    return sum / N;
  }
  // The same with elements of equal stiffness: strength in proportion to d_k.
  [[nodiscard]] double engaged_by_stiffness(const double* s) const {
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < N; ++k) {
      sum += std::clamp(s[k], -limit(k), limit(k));
      all += limit(k);
    }
    return sum / all;
  }
  void rate(double v, const double* s, double* d) const {
    for (std::size_t k = 0; k < N; ++k) d[k] = (v > 0.0 ? s[k] >= limit(k) : s[k] <= -limit(k)) ? 0.0 : v;
  }
  void settle(double* s) const {
    for (std::size_t k = 0; k < N; ++k) s[k] = std::clamp(s[k], -limit(k), limit(k));
  }
  void scales(double* s) const {
    for (std::size_t k = 0; k < N; ++k) s[k] = 20.0 * limit(k);
  }
};

// coulomb-friction/maxwell-slip: F = f mean(s_k / d_k).
struct CoulombMaxwellSlip final : Part {
  double force = 0.0;
  SlipElements<4> contact;
  CoulombMaxwellSlip(double f, double knee) : force(f), contact{knee} {}
  [[nodiscard]] std::size_t states() const override { return 4; }
  void scales(const Scale&, double* s) const override { contact.scales(s); }
  void rate(const Moment& m, const double* s, double* d) const override { contact.rate(m.rod.v, s, d); }
  void settle(const Moment&, double* s) const override { contact.settle(s); }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return force * contact.engaged(s); }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"fc", force, "N"}}; }
};

// coulomb-friction/film: F = f (2 / pi) atan(v / v_f). Source: regularised Coulomb friction, standard.
struct CoulombFilm final : Part {
  double force = 0.0, speed = 1e-3;
  CoulombFilm(double f, double v_f) : force(f), speed(v_f) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * 0.63661977236758134 * std::atan(m.rod.v / speed);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"fc", force, "N"}}; }
};

// coulomb-friction/rate-hardening: F = f (1 + b ln(1 + |v| / v_0)) tanh(v / v_0): the logarithmic direct effect.
// Source: Dieterich, J. Geophys. Res. 84 (1979) 2161-2168, regularised at rest.
struct CoulombRateHardening final : Part {
  double force = 0.0, speed = 1e-3, rise = 0.05;
  CoulombRateHardening(double f, double v_0, double b) : force(f), speed(v_0), rise(b) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * (1.0 + rise * std::log1p(std::abs(m.rod.v) / speed)) * std::tanh(m.rod.v / speed);
  }
};

// seal-friction/lugre: F = f_s s / d,  s' = v - |v| s / (d g),  f_s g = f_c + (f_s - f_c) exp(-|v / v_s|).
// Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419-425, with Tustin's
// exponent 1.
struct SealLugre final : Part {
  double coulomb = 0.0, stick = 0.0, speed = 1e-2, bristle = 4e-5;
  SealLugre(double f_c, double f_s, double v_s, double d) : coulomb(f_c), stick(f_s), speed(v_s), bristle(d) {}
  [[nodiscard]] double level(double v) const {
    return (coulomb + (stick - coulomb) * std::exp(-std::abs(v) / speed)) / stick;
  }
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 20.0 * bristle; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = m.rod.v - std::abs(m.rod.v) * s[0] / (bristle * level(m.rod.v));
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return stick * s[0] / bristle; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"fb", stick - coulomb, "N"}}; }
};

// seal-friction/film: F = (f_c + f_b / (1 + (v / v_s)^2)) tanh(v / v_f).
// Source: Hess, Soom, J. Tribol. 112 (1990) 147-152.
struct SealFilm final : Part {
  double coulomb = 0.0, excess = 0.0, speed = 1e-2, film = 1e-3;
  SealFilm(double f_c, double f_b, double v_s, double v_f) : coulomb(f_c), excess(f_b), speed(v_s), film(v_f) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double v = m.rod.v / speed;
    return (coulomb + excess / (1.0 + v * v)) * std::tanh(m.rod.v / film);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"fb", excess, "N"}}; }
};

// seal-friction/maxwell-slip: F = (f_c + f_b exp(-(v / v_s)^2)) mean(s_k / d_k).
// Source: generalised Maxwell-slip, Lampaert, Al-Bender, Swevers 2003, with the slip level in front of all elements.
struct SealMaxwellSlip final : Part {
  double coulomb = 0.0, excess = 0.0, speed = 1e-2;
  SlipElements<3> contact;
  SealMaxwellSlip(double f_c, double f_b, double v_s, double knee)
      : coulomb(f_c), excess(f_b), speed(v_s), contact{knee} {}
  [[nodiscard]] std::size_t states() const override { return 3; }
  void scales(const Scale&, double* s) const override { contact.scales(s); }
  void rate(const Moment& m, const double* s, double* d) const override { contact.rate(m.rod.v, s, d); }
  void settle(const Moment&, double* s) const override { contact.settle(s); }
  [[nodiscard]] double beside(const Moment& m, const double* s) const override {
    const double v = m.rod.v / speed;
    return (coulomb + excess * std::exp(-v * v)) * contact.engaged(s);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override {
    return {{"fb", excess, "N"}, {"v_st", speed, "m/s"}};
  }
};

// pre-yield-hysteresis/iwan: elements of equal stiffness, slip deflections evenly up to x_y: F = f sum c(s_k) / sum
// d_k. Source: Iwan, J. Appl. Mech. 33 (1966) 893-900.
struct PreYieldIwan final : Part {
  double force = 0.0;
  SlipElements<6> elements;
  PreYieldIwan(double f, double x_y) : force(f), elements{x_y} {}
  [[nodiscard]] std::size_t states() const override { return 6; }
  void scales(const Scale&, double* s) const override { elements.scales(s); }
  void rate(const Moment& m, const double* s, double* d) const override { elements.rate(m.rod.v, s, d); }
  void settle(const Moment&, double* s) const override { elements.settle(s); }
  [[nodiscard]] double beside(const Moment&, const double* s) const override {
    return force * elements.engaged_by_stiffness(s);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"f_h", force, "N"}}; }
};

// pre-yield-hysteresis/sharp-knee: F = f z,  z' = (v / x_y) (1 - |z|^n (1 + sgn(v z)) / 2),  n above 1.
// Source: Wen, J. Eng. Mech. Div. 102 (1976) 249-263.
struct PreYieldSharpKnee final : Part {
  double force = 0.0, length = 1e-3, power = 2.0;
  PreYieldSharpKnee(double f, double x_y, double n) : force(f), length(x_y), power(n) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    const double grip = m.rod.v * s[0] > 0.0 ? std::pow(std::abs(s[0]), power) : 0.0;
    d[0] = m.rod.v / length * (1.0 - grip);
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return force * s[0]; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"f_h", force, "N"}}; }
};

// pre-yield-hysteresis/creeping: F = f z,  z' = (v - |v| z) / x_y - z / T: chains of particles that give way at rest.
// Source: Dahl's equation with relaxation; no accepted form is known.
struct PreYieldCreeping final : Part {
  double force = 0.0, length = 1e-3, time = 1.0;
  PreYieldCreeping(double f, double x_y, double T) : force(f), length(x_y), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = (m.rod.v - std::abs(m.rod.v) * s[0]) / length - s[0] / time;
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override { return force * s[0]; }
};

}  // namespace hysteron::challenge
