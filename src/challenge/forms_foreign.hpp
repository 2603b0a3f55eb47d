// Causes that are in no catalogue, and of which no effect of the catalogue is a form.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// foreign:place-friction: F = f ((x - x_p) / A)^2 sgn v: a bore that narrows away from x_p.
struct PlaceFriction final : Part {
  double force = 0.0, place = 0.0, length = 1.0;
  PlaceFriction(double f, double x_p, double A) : force(f), place(x_p), length(A) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double y = (m.rod.x - place) / length;
    return force * y * y * m.rod.v / std::sqrt(m.rod.v * m.rod.v + 1e-6);
  }
};

// foreign:knee-of-current: the yield displacement grows with the drive, z' / (1 + q i).
struct KneeOfCurrent final : Part {
  double growth = 0.0;
  explicit KneeOfCurrent(double q) : growth(q) {}
  [[nodiscard]] double hysteresis(const Moment& m, double, double) const override {
    return 1.0 / (1.0 + growth * m.drive);
  }
};

// foreign:mount-ladder: F = (f / L) (h(y_1) + h(y_2)),  h(y) = y (1 + (y / L)^2),  y_k' = v - h(y_k) / T_k.
struct MountLadder final : Part {
  double force = 0.0, length = 1e-2, fast = 0.02, slow = 0.2;
  MountLadder(double f, double L, double T_1, double T_2) : force(f), length(L), fast(T_1), slow(T_2) {}
  [[nodiscard]] double stretch(double y) const { return y * (1.0 + y * y / (length * length)); }
  [[nodiscard]] std::size_t states() const override { return 2; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = m.rod.v - stretch(s[0]) / fast;
    d[1] = m.rod.v - stretch(s[1]) / slow;
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override {
    return force / length * (stretch(s[0]) + stretch(s[1]));
  }
};

// foreign:swing-damping: c (1 + d w / A), w the running amplitude of the motion.
struct SwingDamping final : Part {
  double growth = 0.0, length = 1e-2;
  SwingDamping(double d, double A) : growth(d), length(A) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void rate(const Moment& m, const double* s, double* d) const override {
    const double away = std::abs(m.rod.x - m.middle);
    d[0] = (away - s[0]) / (away > s[0] ? 0.02 : 0.8);
  }
  [[nodiscard]] double damping(const Moment&, const double* s, double) const override {
    return 1.0 + growth * s[0] / length;
  }
};

// foreign:supply-cycling: i (1 + d sin(2 pi t / T + p)).
struct SupplyCycling final : Part {
  double depth = 0.0, period = 1.0, phase = 0.0;
  SupplyCycling(double d, double T, double p) : depth(d), period(T), phase(p) {}
  [[nodiscard]] FieldStage field_stage() const override { return FieldStage::supply; }
  void magnetise(std::vector<double>& values, double step, double begin) const override {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double t = begin + step * static_cast<double>(k);
      values[k] *= 1.0 + depth * std::sin(6.2831853071795865 * t / period + phase);
    }
  }
};

// foreign:slip-lock: z' (1 - d / (1 + y^2)),  y = (z sgn(u) / Z - q) / w: the hysteresis sticks where it passes zero.
struct SlipLock final : Part {
  double depth = 0.0, centre = 0.0, width = 0.3;
  SlipLock(double d, double q, double w) : depth(d), centre(q), width(w) {}
  [[nodiscard]] double hysteresis(const Moment&, double u, double z) const override {
    const double y = ((u < 0.0 ? -z : z) - centre) / width;
    return 1.0 - depth / (1.0 + y * y);
  }
};

// A bypass with two positions: it opens above 1, shuts below `back`, and moves within `time`. State 0 is how far it is
// open, state 1 where it is going.
struct Bypass : Part {
  double loss = 0.0;
  explicit Bypass(double d) : loss(d) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  void scales(const Scale&, double* s) const override { s[0] = s[1] = 1.0; }
  [[nodiscard]] virtual double urge(const Moment& m) const = 0;
  void rate(const Moment&, const double* s, double* d) const override {
    d[0] = (s[1] - s[0]) / 0.004;
    d[1] = 0.0;
  }
  void settle(const Moment& m, double* s) const override {
    const double now = urge(m);
    if (now > 1.0) s[1] = 1.0;
    if (now < 0.5) s[1] = 0.0;
  }
  [[nodiscard]] double damping(const Moment&, const double* s, double) const override { return 1.0 - loss * s[0]; }
};

// foreign:blow-off-valve: the bypass opens at the speed V.
struct BlowOffValve final : Bypass {
  double speed = 0.1;
  BlowOffValve(double d, double V) : Bypass(d), speed(V) {}
  [[nodiscard]] double urge(const Moment& m) const override { return std::abs(m.rod.v) / speed; }
};

// foreign:inertia-valve: the bypass opens where the rod gains speed faster than A.
struct InertiaValve final : Bypass {
  double acceleration = 1.0;
  InertiaValve(double d, double A) : Bypass(d), acceleration(A) {}
  [[nodiscard]] double urge(const Moment& m) const override {
    return (m.rod.v < 0.0 ? -m.rod.a : m.rod.a) / acceleration;
  }
};

// foreign:hot-threshold: yield force times 1 - d while the stored heat is above a threshold, and until it has fallen to
// 0.7 of it: theta' = P / E - theta / T.
struct HotThreshold final : Part {
  double loss = 0.0, energy = 1.0, time = 20.0;
  HotThreshold(double d, double E, double T) : loss(d), energy(E), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 3; }
  void scales(const Scale&, double* s) const override { s[0] = s[1] = s[2] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = (m.t < 0.0 ? 0.0 : std::max(m.core * m.v, 0.0)) / energy - s[0] / time;
    d[1] = (s[2] - s[1]) / 0.05;
    d[2] = 0.0;
  }
  void settle(const Moment&, double* s) const override {
    if (s[0] > 1.0) s[2] = 1.0;
    if (s[0] < 0.7) s[2] = 0.0;
  }
  [[nodiscard]] double yield(const Moment&, const double* s) const override { return 1.0 - loss * s[1]; }
};

// foreign:cogging: F = f sin(2 pi x / p + q): magnets or a rack that detent.
struct Cogging final : Part {
  double force = 0.0, pitch = 1e-2, phase = 0.0;
  Cogging(double f, double p, double q) : force(f), pitch(p), phase(q) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * std::sin(6.2831853071795865 * m.rod.x / pitch + phase);
  }
};

// foreign:rig-ringing: F + r (q - F),  q'' = w^2 (F - q) - 2 z w q': the frame rings after every change of force.
struct RigRinging final : Part {
  double share = 0.0, omega = 200.0, damping = 0.05;
  RigRinging(double r, double w, double z) : share(r), omega(w), damping(z) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  void scales(const Scale& scale, double* s) const override {
    s[0] = scale.force;
    s[1] = scale.force * omega;
  }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = s[1];
    d[1] = omega * omega * (m.core - s[0]) - 2.0 * damping * omega * s[1];
  }
  [[nodiscard]] double beside(const Moment& m, const double* s) const override { return share * (s[0] - m.core); }
};

// foreign:fractional: F = (f / A) sum w_k y_k,  y_k' = v - y_k / T_k,  w_k = (T_k / 1 s)^-a, T_k every half decade:
// relaxation by a power law over two decades of time.
struct FractionalRelaxation final : Part {
  static constexpr std::array<double, 5> times = {0.01, 0.03, 0.1, 0.3, 1.0};
  double force = 0.0, length = 1e-2, power = 0.4;
  FractionalRelaxation(double f, double A, double a) : force(f), length(A), power(a) {}
  [[nodiscard]] std::size_t states() const override { return times.size(); }
  void rate(const Moment& m, const double* s, double* d) const override {
    for (std::size_t k = 0; k < times.size(); ++k) d[k] = m.rod.v - s[k] / times[k];
  }
  [[nodiscard]] double beside(const Moment&, const double* s) const override {
    double sum = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) sum += std::pow(times[k], -power) * s[k];
    return force / length * sum;
  }
};

// foreign:driver-threshold: sgn(i) sqrt(i^2 + i_d^2) - i_d: the field builds up only above a current.
struct DriverThreshold final : Part {
  double threshold = 0.1;
  explicit DriverThreshold(double i_d) : threshold(i_d) {}
  [[nodiscard]] FieldStage field_stage() const override { return FieldStage::saturation; }
  void magnetise(std::vector<double>& values, double, double) const override {
    for (double& i : values) i = std::copysign(std::hypot(i, threshold) - threshold, i);
  }
};

// foreign:lever: F (1 + b (x - x_m) / A): the rod turns, and the lever of the load cell with it.
struct LeverGeometry final : Part {
  double slope = 0.0, length = 1e-2;
  LeverGeometry(double b, double A) : slope(b), length(A) {}
  [[nodiscard]] double whole(const Moment& m, const double*, double, double f) const override {
    return f * (1.0 + slope * (m.rod.x - m.middle) / length);
  }
};

// foreign:load-cell-square: F + q F^2 / F_p in the force channel: the cell is not linear.
struct LoadCellSquare final : Part {
  double share = 0.0, peak = 1e3;
  LoadCellSquare(double q, double F_p) : share(q), peak(F_p) {}
  void on_force(std::vector<double>& force, double) const override {
    for (double& f : force) f += share * f * f / peak;
  }
};

// foreign:field-spring: F = k (i / i_1) (x - x_m): the field holds the piston as a spring.
struct FieldSpring final : Part {
  double stiffness = 0.0, level = 1.0;
  FieldSpring(double k, double i_1) : stiffness(k), level(i_1) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return stiffness * m.drive / level * (m.rod.x - m.middle);
  }
};

// foreign:grip-slip: in series F = f r / sqrt(1 + r^2) (1 - b 10 / (10 + |r|)),  r = y' / v_f: the fixture slips in its
// grips, which hold up to f and by b less when they creep.
struct GripSlip final : Part {
  double force = 1e3, film = 1e-4, hump = 0.1;
  GripSlip(double f, double v_f, double b) : force(f), film(v_f), hump(b) {}
  [[nodiscard]] InSeries chain() const override { return InSeries::whole; }
  [[nodiscard]] double series(const Moment&, const double*, double, double rate) const override {
    const double r = rate / film;
    return force * r / std::sqrt(1.0 + r * r) * (1.0 - hump * 10.0 / (10.0 + std::abs(r)));
  }
};

}  // namespace hysteron::challenge
