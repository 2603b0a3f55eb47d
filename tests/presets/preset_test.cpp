// Published parameter sets: complete, convertible, and the same force as their equations integrated as printed.
#include "presets/preset.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "datasets/dataset.hpp"
#include "simulate/composite.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;

double unprinted(std::string_view name) {
  if (name == "n") return 2.0;
  if (name == "A") return 100.0;
  if (name == "beta" || name == "gamma") return 1e5;
  if (name == "c1") return 1e4;
  if (name == "x0") return 0.0;
  return 500.0;
}

Vector quantities(const Preset& preset, double drive, double frequency) {
  Vector result;
  for (const PresetQuantity& quantity : preset.quantities) {
    result.push_back(quantity.at != nullptr ? quantity.at(drive, frequency) : unprinted(quantity.name));
  }
  return result;
}

double quantity(const Preset& preset, std::string_view name, double drive) {
  const auto found = std::ranges::find(preset.quantities, name, &PresetQuantity::name);
  EXPECT_NE(found, preset.quantities.end()) << name;
  return found->at(drive, 1.0);
}

struct Sine {
  Vector time, x, v;
  Sine(double frequency, double amplitude, double duration) : w(2.0 * std::numbers::pi * frequency), a(amplitude) {
    for (int n = 0; n <= static_cast<int>(duration * 1000.0); ++n) {
      const double t = 1e-3 * n;
      time.push_back(t);
      x.push_back(a * std::sin(w * t));
      v.push_back(a * w * std::cos(w * t));
    }
  }
  [[nodiscard]] double velocity(double t) const { return a * w * std::cos(w * t); }
  [[nodiscard]] double position(double t) const { return a * std::sin(w * t); }
  double w, a;
};

Vector simulated(const Preset& preset, double drive, const Sine& motion) {
  const CompositeModel model = make_model(preset.model, {preset.effects.begin(), preset.effects.end()});
  return simulate(model, make_motion(motion.time, motion.x, motion.v, Vector(motion.time.size(), drive), 1e-8),
                  preset.parameters(quantities(preset, drive, motion.w / (2.0 * std::numbers::pi))));
}

// Classical Runge-Kutta with 100 steps between samples.
Vector integrated(const Sine& motion, Vector state, const std::function<Vector(double, const Vector&)>& rate,
                  const std::function<double(double, const Vector&)>& force) {
  const auto shifted = [](const Vector& a, double h, const Vector& b) {
    Vector result = a;
    for (std::size_t i = 0; i < a.size(); ++i) result[i] += h * b[i];
    return result;
  };
  Vector result;
  for (const double start : motion.time) {
    result.push_back(force(start, state));
    const double h = 1e-5;
    for (int k = 0; k < 100; ++k) {
      const double t = start + h * k;
      const Vector k1 = rate(t, state);
      const Vector k2 = rate(t + 0.5 * h, shifted(state, 0.5 * h, k1));
      const Vector k3 = rate(t + 0.5 * h, shifted(state, 0.5 * h, k2));
      const Vector k4 = rate(t + h, shifted(state, h, k3));
      for (std::size_t i = 0; i < state.size(); ++i) state[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
  }
  return result;
}

double largest(const Vector& a) {
  double result = 0.0;
  for (const double value : a) result = std::max(result, std::fabs(value));
  return result;
}

double rms_distance(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Presets, AreCompleteAndSimulate) {
  std::set<std::string_view> ids;
  for (const Preset* preset : preset_catalogue()) {
    SCOPED_TRACE(std::string(preset->id));
    EXPECT_TRUE(ids.insert(preset->id).second);
    EXPECT_EQ(find_preset(preset->id), preset);
    EXPECT_FALSE(preset->title.empty() || preset->reference.empty() || preset->note.empty());
    ASSERT_NE(find_model(preset->model), nullptr);
    const CompositeModel model = make_model(preset->model, {preset->effects.begin(), preset->effects.end()});
    for (const double share : {0.0, 0.3, 1.0}) {
      const double drive = preset->drive_low + share * (preset->drive_high - preset->drive_low);
      ASSERT_EQ(preset->parameters(quantities(*preset, drive, 1.2)).size(), model.parameter_count());
      // A set of one sine alone means nothing on another.
      const Vector force =
          simulated(*preset, drive, preset->id == "nelder-mead-tables" ? Sine(1.0, 0.0025, 1.0) : Sine(1.2, 0.01, 1.0));
      EXPECT_TRUE(std::ranges::all_of(force, [](double f) { return std::isfinite(f); })) << drive;
      EXPECT_GT(largest(force), 0.1) << drive;
      EXPECT_LT(largest(force), 2e4) << drive;
    }
  }
  for (const char* id : {"spencer-1997", "least-squares-table-1", "least-squares-table-2", "rd8040-1-lm", "rd8041-1-lm",
                         "review-13-14", "review-19-21", "review-25-26", "review-27-28", "rd8040-1-pso"}) {
    EXPECT_TRUE(ids.contains(id)) << id;
  }
}

// In the source's own equations and centimetres.
TEST(Presets, SpencerAsPrinted) {
  const Preset& preset = *find_preset("spencer-1997");
  for (const double u : {0.0, 1.5, 2.25}) {
    const Sine motion(2.5, 0.015, 0.8);
    const double alpha = 140.0 + 695.0 * u;
    const double c0 = 21.0 + 3.5 * u;
    const double c1 = 283.0 + 2.95 * u;
    const auto slip = [&](double t, const Vector& s) {
      return (alpha * s[1] + c0 * 100.0 * motion.velocity(t) + 46.9 * (100.0 * motion.position(t) - s[0])) / (c0 + c1);
    };
    // At rest of the spring k0, as every simulation begins.
    const Vector force = integrated(
        motion, {100.0 * motion.position(0.0), 0.0},
        [&](double t, const Vector& s) -> Vector {
          const double dy = slip(t, s);
          const double du = 100.0 * motion.velocity(t) - dy;
          const double z = s[1];
          return {dy, -363.0 * std::fabs(du) * z * std::fabs(z) - 363.0 * du * z * z + 301.0 * du};
        },
        [&](double t, const Vector& s) { return c1 * slip(t, s) + 5.0 * (100.0 * motion.position(t) - 14.3); });
    EXPECT_LT(rms_distance(simulated(preset, u, motion), force), 1e-3 * largest(force)) << u;
  }
  // The prototype gives some 1.5 kN at 2.25 V, 2.5 Hz and 15 mm.
  EXPECT_NEAR(largest(simulated(preset, 2.25, Sine(2.5, 0.015, 0.8))), 1600.0, 200.0);
}

TEST(Presets, BoucWenSetsAsPrinted) {
  for (const char* id : {"least-squares-table-1", "least-squares-table-2", "rd8040-1-lm", "rd8041-1-lm"}) {
    const Preset& preset = *find_preset(id);
    const bool lm = std::string_view(id).starts_with("rd");
    for (const double drive : {0.0, 0.5, 1.0}) {
      const auto q = [&](std::string_view name) { return quantity(preset, name, drive); };
      const double alpha = lm ? q("alpha_a") + 1e3 * q("alpha_b") * drive : q("alpha");
      const double c0 = lm ? q("c0a") + 1e3 * q("c0b") * drive : q("c0");
      const double k0 = lm ? 1e3 * q("k0a") : q("k0");
      const double n = q("n");
      const Sine motion(0.4, 0.01, 3.0);
      const Vector force = integrated(
          motion, {0.0},
          [&](double t, const Vector& s) -> Vector {
            const double v = motion.velocity(t);
            const double z = s[0];
            return {-q("gamma") * std::fabs(v) * z * std::pow(std::fabs(z), n - 1.0) -
                    q("beta") * v * std::pow(std::fabs(z), n) + q("A") * v};
          },
          [&](double t, const Vector& s) {
            return c0 * motion.velocity(t) + k0 * (motion.position(t) - q("x0")) + alpha * s[0];
          });
      EXPECT_LT(rms_distance(simulated(preset, drive, motion), force), 1e-3 * largest(force)) << id << " " << drive;
    }
  }
}

// The dataset is made from the same polynomials by its own conversion, plus noise of 1 % of the peak.
TEST(Presets, PolynomialsOfTheTwin) {
  const Preset& preset = *find_preset("rd8040-1-pso");
  const Campaign twin = find_dataset("rd8040-twin")->generate(Stream(1));
  const CompositeModel model = make_model(preset.model, {preset.effects.begin(), preset.effects.end()});
  for (const char* file : {"2.0Hz_1.0A.csv", "0.4Hz_0.0A.csv", "1.2Hz_0.5A.csv"}) {
    const auto recording = std::ranges::find(twin.recordings, file, &Recording::file);
    ASSERT_NE(recording, twin.recordings.end());
    const double frequency = std::stod(file);
    const double drive = std::stod(std::string(file).substr(6));
    // Three periods beforehand, to reach the settled cycle the recording starts in.
    const Sine motion(frequency, 0.025, 4.0 / frequency);
    const Vector force = simulate(model, make_motion(motion.time, motion.x, motion.v, {}, 1e-8),
                                  preset.parameters(quantities(preset, drive, frequency)));
    double squares = 0.0;
    for (std::size_t n = 0; n < 100; ++n) {
      const auto at = static_cast<std::size_t>(std::lround(1000.0 * (3.0 / frequency + recording->time[n])));
      const double residual = force[at] - recording->force[n];
      squares += residual * residual / 100.0;
    }
    EXPECT_LT(std::sqrt(squares), 0.015 * largest(recording->force)) << file;
  }
}

TEST(Presets, LagOfTheDriveIsFirstOrder) {
  Vector time, drive;
  for (int n = 0; n <= 100; ++n) {
    time.push_back(1e-3 * n);
    drive.push_back(n <= 20 ? 1.0 : 1.0 + 50.0 * (time.back() - 0.02));
  }
  const Vector result = lagged(time, drive, 0.01);
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double t = std::max(0.0, time[n] - 0.02);
    EXPECT_NEAR(result[n], 1.0 + 50.0 * (t - 0.01 * (1.0 - std::exp(-t / 0.01))), 1e-12);
  }
  EXPECT_EQ(lagged(time, drive, 0.0), drive);
}

// The sixteen parameters at one current and one sine: the force as Wang et al. write it, with the exponentials.
TEST(Presets, NelderMeadTablesGiveTheForceOfTheSource) {
  const Preset* preset = find_preset("nelder-mead-tables");
  ASSERT_NE(preset, nullptr);
  const Sine motion(1.0, 0.0025, 1.0);
  const double v_m = motion.a * motion.w;
  double before = 0.0;
  for (const double current : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    const auto q = [&](std::string_view name) { return quantity(*preset, name, current); };
    const auto gain = [&](const char* slope, const char* turn) {
      return 1.0 / (1.0 + std::exp(-q(slope) * (current + q(turn)))) - 1.0 / (1.0 + std::exp(-q(slope) * q(turn)));
    };
    const double f_t = q("f0") * (1.0 + std::exp(q("a1") * v_m)) * (1.0 + q("k2") * gain("a2", "I0"));
    const double width = q("k4") * v_m * (1.0 + q("k3") * gain("a3", "I1"));
    const double alpha = q("a0") / (1.0 + q("k0") * v_m);
    const Vector force = simulated(*preset, current, motion);
    for (std::size_t n = 5; n < force.size(); n += 40) {
      const double v = motion.v[n];
      const double a = -motion.w * motion.w * motion.x[n];
      if (std::fabs(a) < 0.08) continue;  // where the rounded sign of the acceleration turns
      const double u = alpha * (v - q("k6") * v_m + std::copysign(width, a * width));
      const double damping = (v > 0.0 ? q("k1c") * v : -q("k1e") * v) * std::exp(-q("a4") * v_m);
      const double expected = f_t * ((1.0 - std::exp(-u)) / (1.0 + std::exp(-u)) * (1.0 + damping) + q("k5"));
      EXPECT_NEAR(force[n], expected, 0.01 * f_t) << current << " A, sample " << n;
    }
    // A magnetorheological damper: stronger with every step of the current.
    EXPECT_GT(f_t, before) << current;
    before = f_t;
  }
}

}  // namespace
}  // namespace hysteron
