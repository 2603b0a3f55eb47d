// What changes over seconds: heat, wear, rest, drift.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

// Dissipated power, W; nothing is counted before the recording begins.
inline double heating_power(const Moment& m) { return m.t < 0.0 ? 0.0 : std::max(m.core * m.v, 0.0); }

// One store of heat: theta' = P / C - theta / T_c, in units of C = energy.
struct HeatStore : Part {
  double energy = 1.0, cooling = 60.0;
  HeatStore(double C, double T_c) : energy(C), cooling(T_c) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = heating_power(m) / energy - s[0] / cooling;
  }
  [[nodiscard]] bool goes_on() const override { return true; }
  void rest(double pause, double* s) const override { s[0] *= std::exp(-pause / cooling); }
};

// self-heating/damping: c exp(-b theta); the yield force stays. Source: Reynolds's law of viscosity.
struct DampingHeat final : HeatStore {
  double loss = 0.0;
  DampingHeat(double C, double T_c, double b) : HeatStore(C, T_c), loss(b) {}
  [[nodiscard]] double damping(const Moment&, const double* s, double) const override { return std::exp(-loss * s[0]); }
};

// self-heating/yield: yield force / (1 + b theta); the viscosity stays. Source: magnetisation falls with temperature.
struct YieldHeat final : HeatStore {
  double loss = 0.0;
  YieldHeat(double C, double T_c, double b) : HeatStore(C, T_c), loss(b) {}
  [[nodiscard]] double yield(const Moment&, const double* s) const override {
    return 1.0 / (1.0 + loss * std::max(s[0], 0.0));
  }
};

// self-heating/arrhenius: c exp(-b theta / (1 + theta / 8)), yield force likewise with a part of b.
// Source: Arrhenius's law about a reference temperature.
struct ArrheniusHeat final : HeatStore {
  double loss = 0.0, yield_part = 0.5;
  ArrheniusHeat(double C, double T_c, double b, double part) : HeatStore(C, T_c), loss(b), yield_part(part) {}
  [[nodiscard]] double fall(double theta) const { return theta / (1.0 + std::max(theta, 0.0) / 8.0); }
  [[nodiscard]] double damping(const Moment&, const double* s, double) const override {
    return std::exp(-loss * fall(s[0]));
  }
  [[nodiscard]] double yield(const Moment&, const double* s) const override {
    return std::exp(-yield_part * loss * fall(s[0]));
  }
};

// self-heating/two-stores: fluid and body, theta_1' = P / C - (theta_1 - theta_2) / T_1,
// theta_2' = r (theta_1 - theta_2) / T_1 - theta_2 / T_2; c exp(-b theta_1), yield force exp(-part b theta_1).
// Source: lumped thermal network, standard.
struct TwoStoreHeat final : Part {
  double energy = 1.0, exchange = 3.0, cooling = 60.0, ratio = 0.2, loss = 0.0, yield_part = 0.5;
  TwoStoreHeat(double C, double T_1, double T_2, double r, double b, double part)
      : energy(C), exchange(T_1), cooling(T_2), ratio(r), loss(b), yield_part(part) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  void scales(const Scale&, double* s) const override { s[0] = s[1] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    const double flow = (s[0] - s[1]) / exchange;
    d[0] = heating_power(m) / energy - flow;
    d[1] = ratio * flow - s[1] / cooling;
  }
  [[nodiscard]] bool goes_on() const override { return true; }
  // Midpoint rule in steps short beside the exchange.
  void rest(double pause, double* s) const override {
    const auto steps = static_cast<int>(std::ceil(20.0 * pause / std::min(exchange, cooling)));
    const double h = pause / std::max(steps, 1);
    const auto rates = [&](double a, double b) {
      const double flow = (a - b) / exchange;
      return std::array<double, 2>{-flow, ratio * flow - b / cooling};
    };
    for (int k = 0; k < steps; ++k) {
      const auto half = rates(s[0], s[1]);
      const auto all = rates(s[0] + 0.5 * h * half[0], s[1] + 0.5 * h * half[1]);
      s[0] += h * all[0];
      s[1] += h * all[1];
    }
  }
  [[nodiscard]] double damping(const Moment&, const double* s, double) const override { return std::exp(-loss * s[0]); }
  [[nodiscard]] double yield(const Moment&, const double* s) const override {
    return std::exp(-yield_part * loss * s[0]);
  }
};

// degradation/energy: F (1 - d (1 - exp(-E / E_0))),  E' = F v: wear that ends. Source: saturating damage, standard.
struct EnergyWear final : Part {
  double loss = 0.0, energy = 1.0;
  EnergyWear(double d, double E_0) : loss(d), energy(E_0) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double*, double* d) const override { d[0] = heating_power(m) / energy; }
  [[nodiscard]] bool goes_on() const override { return true; }
  [[nodiscard]] double whole(const Moment&, const double* s, double, double f) const override {
    return f * (1.0 + loss * std::expm1(-s[0]));
  }
};

// degradation/path: F exp(-s / L),  s' = |v|. Source: Archard's law of wear with the load left out.
struct PathWear final : Part {
  double length = 1.0;
  explicit PathWear(double L) : length(L) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double*, double* d) const override {
    d[0] = m.t < 0.0 ? 0.0 : std::abs(m.rod.v) / length;
  }
  [[nodiscard]] bool goes_on() const override { return true; }
  [[nodiscard]] double whole(const Moment&, const double* s, double, double f) const override {
    return f * std::exp(-s[0]);
  }
};

// degradation/cycles: F / (1 + d N), N the number of turns of the motion, each counted over a short path after it.
// Source: cyclic deterioration, Rahnama, Krawinkler 1993, per half-cycle.
struct CycleWear final : Part {
  double loss = 0.0, turn_length = 1e-3;
  CycleWear(double d, double path) : loss(d), turn_length(path) {}
  // The counted turns, the last direction, the turns that are due.
  [[nodiscard]] std::size_t states() const override { return 3; }
  void scales(const Scale&, double* s) const override { s[0] = s[1] = s[2] = 100.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = (s[2] - s[0]) * std::abs(m.rod.v) / turn_length;
    d[1] = d[2] = 0.0;
  }
  void settle(const Moment& m, double* s) const override {
    const double sense = m.rod.v > 0.0 ? 1.0 : m.rod.v < 0.0 ? -1.0 : s[1];
    if (m.t > 0.0 && s[1] != 0.0 && sense != s[1]) s[2] += 1.0;
    s[1] = sense;
  }
  [[nodiscard]] bool goes_on() const override { return true; }
  void rest(double, double* s) const override {
    s[0] = s[2];
    s[1] = 0.0;
  }
  [[nodiscard]] double whole(const Moment&, const double* s, double, double f) const override {
    return f / (1.0 + loss * s[0]);
  }
};

// stiction/path: F (1 + a / (1 + s / L)^2),  s' = |v|. Source: no accepted form is known.
struct PathStiction final : Part {
  double excess = 0.0, length = 1e-2;
  PathStiction(double a, double L) : excess(a), length(L) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double*, double* d) const override {
    d[0] = m.t < 0.0 ? 0.0 : std::abs(m.v) / length;
  }
  [[nodiscard]] double whole(const Moment&, const double* s, double, double f) const override {
    return f * (1.0 + excess / ((1.0 + s[0]) * (1.0 + s[0])));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"a", excess, "1"}}; }
};

// stiction/time: F (1 + a exp(-t / T)). Source: remixing of a settled suspension at a rate of its own.
struct TimeStiction final : Part {
  double excess = 0.0, time = 0.3;
  TimeStiction(double a, double T) : excess(a), time(T) {}
  [[nodiscard]] double whole(const Moment& m, const double*, double, double f) const override {
    return f * (1.0 + excess * std::exp(-std::max(m.t, 0.0) / time));
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"a", excess, "1"}}; }
};

// stiction/thixotropic: F (1 + a lambda),  lambda' = (1 - lambda) / T - lambda |v| / L: structure that is broken down
// by shear and built up again. Source: Mewis, Wagner, Adv. Colloid Interface Sci. 147 (2009) 214-227.
struct ThixotropicStiction final : Part {
  double excess = 0.0, length = 1e-2, time = 20.0;
  ThixotropicStiction(double a, double L, double T) : excess(a), length(L), time(T) {}
  [[nodiscard]] std::size_t states() const override { return 1; }
  void scales(const Scale&, double* s) const override { s[0] = 1.0; }
  void start(const Moment&, double* s) const override { s[0] = 1.0; }
  void rate(const Moment& m, const double* s, double* d) const override {
    d[0] = m.t < 0.0 ? 0.0 : (1.0 - s[0]) / time - s[0] * std::abs(m.v) / length;
  }
  [[nodiscard]] bool goes_on() const override { return true; }
  void rest(double pause, double* s) const override { s[0] = 1.0 - (1.0 - s[0]) * std::exp(-pause / time); }
  [[nodiscard]] double whole(const Moment&, const double* s, double, double f) const override {
    return f * (1.0 + excess * s[0]);
  }
  [[nodiscard]] std::vector<TrueParameter> parameters() const override { return {{"a", excess, "1"}}; }
};

// force-drift/settling: F + f (1 - exp(-t / T)). Source: warming of a load cell, standard.
struct SettlingDrift final : Part {
  double force = 0.0, time = 5.0;
  SettlingDrift(double f, double T) : force(f), time(T) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return -force * std::expm1(-std::max(m.t, 0.0) / time);
  }
};

// force-drift/slow-sine: F + f (sin(w t + p) - sin p), less than half a cycle in the longest test.
// Source: temperature of the laboratory.
struct SlowSineDrift final : Part {
  double force = 0.0, omega = 0.1, phase = 0.0;
  SlowSineDrift(double f, double w, double p) : force(f), omega(w), phase(p) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    return force * (std::sin(omega * std::max(m.t, 0.0) + phase) - std::sin(phase));
  }
};

// force-drift/walk: F + f sum (sin(k w t + p_k) - sin p_k) / k, other phases in every test: a smoothed random walk.
// Source: spectrum 1 / k^2 of a random walk.
struct WalkDrift final : Part {
  static constexpr std::size_t waves = 4;
  double force = 0.0, omega = 0.1;
  std::vector<double> phases;
  WalkDrift(double f, double w, std::vector<double> p) : force(f), omega(w), phases(std::move(p)) {}
  [[nodiscard]] double beside(const Moment& m, const double*) const override {
    const double t = std::max(m.t, 0.0);
    double sum = 0.0;
    for (std::size_t k = 0; k < waves; ++k) {
      const double p = phases[(m.test * waves + k) % phases.size()];
      sum += (std::sin(static_cast<double>(k + 1) * omega * t + p) - std::sin(p)) / static_cast<double>(k + 1);
    }
    return force * sum;
  }
};

}  // namespace hysteron::challenge
