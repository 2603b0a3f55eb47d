// What recurs with the motion is told from noise of any colour and from recordings that differ by chance.
#include "diagnose/residual/recurrence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "diagnose/residual/structure.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

struct Left {
  std::vector<Recording> recordings;
  Residuals residuals;
};

// What a model leaves of four motions: a multiple of the force and a constant that differ from one to the next, noise
// of 5 N whose neighbours correlate by `colour`, and `extra`, a function of displacement in cm and velocity in m/s.
Left left_of(double scatter, double colour, const std::function<double(double, double)>& extra, std::uint64_t seed) {
  Left result;
  const Stream stream = Stream(seed);
  std::uint64_t drawn = 0;
  for (const double frequency : {0.9, 1.7, 2.3, 3.1}) {
    Recording recording = testing::motion("r.csv", {{0.01, frequency}, {0.006, 0.37 * frequency}}, 8.0, 3000, 0.2);
    Residual residual;
    const double factor = scatter * stream.normal(drawn++);
    const double offset = scatter * stream.normal(drawn++);
    double noise = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double x = 100.0 * recording.displacement[n];
      const double v = recording.velocity[n];
      noise = colour * noise + std::sqrt(1.0 - colour * colour) * stream.normal(drawn++);
      const double force = 1000.0 * std::tanh(v / 0.02) + 500.0 * v;
      residual.force.push_back(factor * force + 1000.0 * offset + 5.0 * noise + extra(x, v));
      recording.force.push_back(force - residual.force.back());
    }
    result.recordings.push_back(std::move(recording));
    result.residuals.of.push_back(std::move(residual));
    result.residuals.norms.push_back(1500.0);
  }
  return result;
}

Recurrence of(const Left& left) { return recurrence_of(left.recordings, left.residuals); }

const auto nothing = [](double, double) { return 0.0; };

TEST(Recurrence, NoiseOfAnyColourIsNone) {
  for (const double colour : {0.0, 0.99}) {
    int taken_for = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      taken_for += recurs(of(left_of(0.0, colour, nothing, seed))) ? 1 : 0;
    }
    // Nineteen shifts and half as far again leave chance less than one in twenty.
    EXPECT_LE(taken_for, 2) << colour;
  }
}

// Sines of noise whose neighbours correlate as of a time constant in s, and `size` times the noise of a force that
// follows the motion.
Left on_sines(double tau, double size, std::uint64_t seed) {
  Left result;
  const Stream stream = Stream(seed);
  std::uint64_t drawn = 0;
  for (const double frequency : {0.8, 1.3, 2.1}) {
    Recording recording = testing::motion("r.csv", {{0.01, frequency}}, 6.0, 1500, 0.2);
    Residual residual;
    const double colour = tau > 0.0 ? std::exp(-6.0 / 1499.0 / tau) : 0.0;
    double noise = stream.normal(drawn++);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double v = recording.velocity[n];
      noise = colour * noise + std::sqrt(1.0 - colour * colour) * stream.normal(drawn++);
      residual.force.push_back(5.0 * noise +
                               7.0 * size * std::cos(310.0 * recording.displacement[n]) * std::tanh(v / 0.02));
      recording.force.push_back(1000.0 * std::tanh(v / 0.02) + 500.0 * v - residual.force.back());
    }
    result.recordings.push_back(std::move(recording));
    result.residuals.of.push_back(std::move(residual));
    result.residuals.norms.push_back(1500.0);
  }
  return result;
}

TEST(Recurrence, OneNoiseInTwentyRecursWithASine) {
  for (const double tau : {0.0, 0.02, 0.1, 1.0}) {
    int odd = 0;
    for (std::uint64_t draw = 1; draw <= 40; ++draw) {
      odd += recurs(of(on_sines(tau, 0.0, draw))) ? 1 : 0;
    }
    // Two are expected of forty; seven or more come once in two hundred times.
    EXPECT_LT(odd, 7) << tau;
  }
}

TEST(Recurrence, WhatRepeatsWithASineIsNotWhatChanceIsMeasuredBy) {
  // A shift of the whole residual would leave it repeating with the motion, at another phase.
  for (std::uint64_t draw = 1; draw <= 10; ++draw) {
    const Recurrence with = of(on_sines(0.02, 0.3, draw));
    EXPECT_TRUE(recurs(with)) << draw;
    const Recurrence alone = of(on_sines(0.02, 0.0, draw));
    EXPECT_LT(with.most_by_chance, 1.5 * alone.most_by_chance) << draw;
  }
}

TEST(Recurrence, RecordingsThatDifferByChanceAreNone) {
  const Recurrence found = of(left_of(0.05, 0.5, nothing, 3));
  EXPECT_FALSE(recurs(found));
  EXPECT_LT(found.share, 0.05);
}

TEST(Recurrence, SeesWhatIsTooSmallToBeSeenInOneRecording) {
  // Its mean square is a fiftieth of the noise's.
  const Left left = left_of(
      0.0, 0.0, [](double x, double v) { return 0.7 * x * x * std::tanh(v / 0.02); }, 7);
  for (std::size_t k = 0; k < left.recordings.size(); ++k) {
    EXPECT_LT(predictable_share(left.recordings[k], left.residuals.of[k].force), 0.03);
  }
  EXPECT_TRUE(recurs(of(left)));
}

TEST(Recurrence, MoreThanChanceWhateverTheUnits) {
  Left left = left_of(
      0.0, 0.0, [](double x, double) { return 10.0 * x * x * x; }, 7);
  const Recurrence before = of(left);
  EXPECT_TRUE(recurs(before));
  for (std::size_t k = 0; k < left.recordings.size(); ++k) {
    for (std::size_t n = 0; n < left.recordings[k].size(); ++n) {
      left.recordings[k].displacement[n] *= 1e3;
      left.recordings[k].velocity[n] *= 1e3;
      left.recordings[k].force[n] *= 1e-3;
      left.residuals.of[k].force[n] *= 1e-3;
    }
    left.residuals.norms[k] *= 1e-3;
  }
  const Recurrence after = of(left);
  EXPECT_NEAR(after.share, before.share, 1e-6);
  EXPECT_NEAR(after.most_by_chance, before.most_by_chance, 1e-6);
}

TEST(Recurrence, TooFewSamplesAreNone) {
  Left left = left_of(0.0, 0.0, nothing, 1);
  for (Residual& residual : left.residuals.of) {
    residual.from = residual.force.size() - 100;
  }
  EXPECT_FALSE(recurs(of(left)));
  EXPECT_FALSE(recurs(recurrence_of({}, {})));
}

}  // namespace
}  // namespace hysteron
