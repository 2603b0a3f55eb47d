// From the command to the field, and the measuring chain.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "challenge/part.hpp"

namespace hysteron::challenge {

struct CoilPart : Part {
  [[nodiscard]] FieldStage field_stage() const final { return FieldStage::coil; }
};

// coil-lag/eddy-currents: i = (1 - w) y(T_1) + w y(T_2), y(T) the command behind a first-order lag of T.
// Source: field diffusion, its first two terms.
struct EddyCoil final : CoilPart {
  double fast = 0.01, slow = 0.1, share = 0.3;
  EddyCoil(double T_1, double T_2, double w) : fast(T_1), slow(T_2), share(w) {}
  void magnetise(std::vector<double>& values, double step, double) const override {
    const double keep_fast = std::exp(-step / fast);
    const double keep_slow = std::exp(-step / slow);
    double a = values.front();
    double b = a;
    for (double& value : values) {
      a = value + (a - value) * keep_fast;
      b = value + (b - value) * keep_slow;
      value = (1.0 - share) * a + share * b;
    }
  }
};

// coil-lag/saturable: i' = (i_cmd - i) / T(i),  T = T_0 / (1 + (i / i_0)^2): the inductance falls as the core
// saturates. Source: inductance as the slope of flux over current.
struct SaturableCoil final : CoilPart {
  double time = 0.02, level = 1.0;
  SaturableCoil(double T_0, double i_0) : time(T_0), level(i_0) {}
  void magnetise(std::vector<double>& values, double step, double) const override {
    double i = values.front();
    for (double& value : values) {
      const double T = time / (1.0 + i * i / (level * level));
      i = value + (i - value) * std::exp(-step / T);
      value = i;
    }
  }
};

// coil-lag/current-loop: i'' = w^2 (i_cmd - i) - 2 z w i': a driver with an integral controller, z below 1.
// Source: second-order lag, standard.
struct LoopCoil final : CoilPart {
  double omega = 100.0, damping = 0.8;
  LoopCoil(double w, double z) : omega(w), damping(z) {}
  void magnetise(std::vector<double>& values, double step, double) const override {
    double i = values.front();
    double rate = 0.0;
    for (double& value : values) {
      rate += step * (omega * omega * (value - i) - 2.0 * damping * omega * rate);
      i += step * rate;
      value = i;
    }
  }
};

// A curve of the field over the current with slope 1 at none and the limit i_s.
struct SaturationCurve : Part {
  double limit = 1.0;
  explicit SaturationCurve(double i_s) : limit(i_s) {}
  [[nodiscard]] FieldStage field_stage() const final { return FieldStage::saturation; }
  [[nodiscard]] virtual double curve(double i) const = 0;
  void magnetise(std::vector<double>& values, double, double) const final {
    for (double& value : values) value = curve(value);
  }
};

// magnetic-saturation/arctan: (2 i_s / pi) atan(pi i / (2 i_s)). Source: standard.
struct ArctanSaturation final : SaturationCurve {
  using SaturationCurve::SaturationCurve;
  [[nodiscard]] double curve(double i) const override {
    return 0.63661977236758134 * limit * std::atan(1.5707963267948966 * i / limit);
  }
};

// magnetic-saturation/langevin: i_s (coth y - 1 / y),  y = 3 i / i_s. Source: Langevin 1905.
struct LangevinSaturation final : SaturationCurve {
  using SaturationCurve::SaturationCurve;
  [[nodiscard]] double curve(double i) const override {
    const double y = 3.0 * i / limit;
    return std::abs(y) < 1e-3 ? i : limit * (1.0 / std::tanh(y) - 1.0 / y);
  }
};

// magnetic-saturation/froehlich: i / (1 + |i| / i_s). Source: Froehlich 1881.
struct FroehlichSaturation final : SaturationCurve {
  using SaturationCurve::SaturationCurve;
  [[nodiscard]] double curve(double i) const override { return i / (1.0 + std::abs(i) / limit); }
};

// magnetic-saturation/knee: i up to i_s, a tenth of the slope above. Source: piecewise linear magnetisation.
struct KneeSaturation final : SaturationCurve {
  using SaturationCurve::SaturationCurve;
  [[nodiscard]] double curve(double i) const override {
    const double size = std::abs(i);
    return std::copysign(std::min(size, limit) + 0.1 * std::max(size - limit, 0.0), i);
  }
};

struct RemanencePart : Part {
  [[nodiscard]] FieldStage field_stage() const final { return FieldStage::remanence; }
};

// magnetic-remanence/plays: mean of four plays of half widths w / 4, 3 w / 4, 5 w / 4, 7 w / 4.
// Source: Prandtl, Ishlinskii; Krasnosel'skii, Pokrovskii, Systems with Hysteresis, Springer 1989.
struct PlaysRemanence final : RemanencePart {
  double width = 0.1;
  explicit PlaysRemanence(double w) : width(w) {}
  void magnetise(std::vector<double>& values, double, double) const override {
    std::array<double, 4> play{};
    play.fill(values.front());
    for (double& value : values) {
      double sum = 0.0;
      for (std::size_t k = 0; k < play.size(); ++k) {
        const double w = width * (0.25 + 0.5 * static_cast<double>(k));
        play[k] = std::clamp(play[k], value - w, value + w);
        sum += play[k];
      }
      value = 0.25 * sum;
    }
  }
};

// magnetic-remanence/jiles: dm = (i - m) |di| / w: the magnetisation follows the current over the path of it.
// Source: irreversible part of Jiles, Atherton, J. Magn. Magn. Mater. 61 (1986) 48-60, with a linear anhysteretic.
struct JilesRemanence final : RemanencePart {
  double width = 0.1;
  explicit JilesRemanence(double w) : width(w) {}
  void magnetise(std::vector<double>& values, double, double) const override {
    double m = values.front();
    double before = m;
    for (double& value : values) {
      // Exact along a straight piece of the path.
      const double change = value - before;
      const double path = std::abs(change) / width;
      if (path > 0.0) {
        const double slope = change / path;
        m = value - slope + (m - before + slope) * std::exp(-path);
      }
      before = value;
      value = m;
    }
  }
};

// magnetic-remanence/last-extreme: i + w d / (|d| + w),  d = e - i, e the current of the last turn.
// Source: a minor loop's offset, rational; no accepted form is known.
struct LastExtremeRemanence final : RemanencePart {
  double width = 0.1;
  explicit LastExtremeRemanence(double w) : width(w) {}
  void magnetise(std::vector<double>& values, double, double) const override {
    double extreme = values.front();
    double before = extreme;
    double sense = 0.0;
    for (double& value : values) {
      const double change = value - before;
      if (change * sense < 0.0) extreme = before;
      if (change != 0.0) sense = change;
      before = value;
      const double d = extreme - value;
      value += width * d / (std::abs(d) + width);
    }
  }
};

// A channel as it was `points` grid points before, linear between them; the first value is held.
inline void delay_channel(std::vector<double>& signal, double points) {
  const std::vector<double> now = signal;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double place = std::max(static_cast<double>(k) - points, 0.0);
    const auto at = std::min(static_cast<std::size_t>(place), now.size() - 2);
    signal[k] = now[at] + (place - static_cast<double>(at)) * (now[at + 1] - now[at]);
  }
}

// y' = (u - y) / T, exact for a signal that is straight between grid points; settled at the first value.
inline void lag_channel(std::vector<double>& signal, double points) {
  const double keep = std::exp(-1.0 / points);
  double y = signal.front();
  double before = y;
  for (double& value : signal) {
    const double slope = value - before;
    y = value - slope * points + (y - before + slope * points) * keep;
    before = value;
    value = y;
  }
}

// Bessel low-pass of order 2 with the delay T: y'' = (3 (u - y) - 3 T y') / T^2, by the trapezoidal rule.
// Source: Thomson, Proc. IEE 96 III (1949) 487-490.
inline void bessel_channel(std::vector<double>& signal, double points) {
  double y = signal.front();
  double w = 0.0;  // T y'
  double before = y;
  const double h = 0.5 / points;
  for (double& value : signal) {
    const double u = 0.5 * (value + before);
    const double next = (w * (1.0 - 3.0 * h - 3.0 * h * h) + 6.0 * h * (u - y)) / (1.0 + 3.0 * h + 3.0 * h * h);
    y += h * (w + next);
    w = next;
    before = value;
    value = y;
  }
}

struct ForceLate : Part {
  double lag = 0.0;
  explicit ForceLate(double T) : lag(T) {}
  [[nodiscard]] std::vector<TrueParameter> parameters() const final { return {{"lag", lag, "s"}}; }
};

// sensor-delay/transport: F(t - T). Source: standard.
struct ForceTransport final : ForceLate {
  using ForceLate::ForceLate;
  void on_force(std::vector<double>& force, double rate) const override { delay_channel(force, lag * rate); }
};

// sensor-delay/low-pass: F behind a first-order filter of T. Source: standard.
struct ForceLowPass final : ForceLate {
  using ForceLate::ForceLate;
  void on_force(std::vector<double>& force, double rate) const override { lag_channel(force, lag * rate); }
};

// sensor-delay/bessel: F behind a Bessel filter of order 2 and delay T. Source: Thomson 1949.
struct ForceBessel final : ForceLate {
  using ForceLate::ForceLate;
  void on_force(std::vector<double>& force, double rate) const override { bessel_channel(force, lag * rate); }
};

struct VelocityLate : Part {
  double lag = 0.0;
  explicit VelocityLate(double T) : lag(T) {}
  [[nodiscard]] double velocity_delay() const final { return lag; }
  [[nodiscard]] std::vector<TrueParameter> parameters() const final { return {{"lag", lag, "s"}}; }
};

// velocity-lag/transport: v(t - T). Source: standard.
struct VelocityTransport final : VelocityLate {
  using VelocityLate::VelocityLate;
  void on_velocity(std::vector<double>& v, double rate) const override { delay_channel(v, lag * rate); }
};

// velocity-lag/bessel: v behind a Bessel filter of order 2 and delay T. Source: Thomson 1949.
struct VelocityBessel final : VelocityLate {
  using VelocityLate::VelocityLate;
  void on_velocity(std::vector<double>& v, double rate) const override { bessel_channel(v, lag * rate); }
};

// velocity-lag/window: the mean of v over the last 2 T: a differentiator with a one-sided window. Source: standard.
struct VelocityWindow final : VelocityLate {
  using VelocityLate::VelocityLate;
  void on_velocity(std::vector<double>& v, double rate) const override {
    const auto width = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(2.0 * lag * rate)) + 1);
    std::vector<double> sums(v.size() + 1, 0.0);
    for (std::size_t k = 0; k < v.size(); ++k) sums[k + 1] = sums[k] + v[k];
    const double first = v.front();
    for (std::size_t k = v.size(); k-- > 0;) {
      const std::size_t from = k + 1 > width ? k + 1 - width : 0;
      const double missing = static_cast<double>(width - (k + 1 - from));
      v[k] = (sums[k + 1] - sums[from] + missing * first) / static_cast<double>(width);
    }
  }
};

}  // namespace hysteron::challenge
