#include "diagnose/signal/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "diagnose/residual/evenness.hpp"
#include "diagnose/residual/structure.hpp"
#include "fit/synthetic.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t seed = 11;

// A force with a knee, so that the estimate has something to be fooled by.
Recording noisy(double white, double coloured, double correlation, std::uint64_t draw = seed,
                const std::vector<testing::Tone>& tones = {{0.01, 2.0}}) {
  Recording recording = testing::motion("r.csv", tones, 6.0, 3000, 0.2);
  recording.velocity_measured = true;
  const Stream stream = Stream(draw);
  double state = 0.0;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    state = correlation * state + std::sqrt(1.0 - correlation * correlation) * stream.normal(n, 1);
    recording.force.push_back(800.0 * std::tanh(recording.velocity[n] / 0.02) + 2000.0 * recording.velocity[n] +
                              white * stream.normal(n) + coloured * state);
  }
  return recording;
}

TEST(NoiseFloor, FindsTheDeviationOfWhiteNoiseFromCycles) {
  const NoiseFloor floor = noise_floor(noisy(10.0, 0.0, 0.0));
  EXPECT_EQ(floor.method, NoiseMethod::cycles);
  EXPECT_NEAR(floor.sigma, 10.0, 0.6);
  EXPECT_NEAR(floor.white, 10.0, 0.8);
}

TEST(NoiseFloor, HoldsColouredNoiseToo) {
  const NoiseFloor floor = noise_floor(noisy(5.0, 10.0, 0.9));
  EXPECT_NEAR(floor.sigma, std::hypot(5.0, 10.0), 1.7);
  EXPECT_LT(floor.white, 0.8 * floor.sigma);
}

TEST(NoiseFloor, SurvivesOutliers) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  for (std::size_t n = 50; n < recording.size(); n += 300) {
    recording.force[n] += 2000.0;
  }
  EXPECT_NEAR(noise_floor(recording).sigma, 10.0, 1.0);
}

TEST(NoiseFloor, HoldsTheRoundingThatRepeatsWithTheCycles) {
  Recording recording = noisy(1.0, 0.0, 0.0);
  for (double& force : recording.force) {
    force = 60.0 * std::round(force / 60.0);
  }
  const NoiseFloor floor = noise_floor(recording);
  EXPECT_GE(floor.sigma, 60.0 / std::sqrt(12.0));
  EXPECT_GE(floor.white, 60.0 / std::sqrt(12.0));
}

TEST(NoiseFloor, FindsThePeriod) {
  const Periodicity cycle = periodicity(noisy(1.0, 0.0, 0.0));
  EXPECT_NEAR(cycle.period, 0.5, 1e-4);
  Recording sweep = testing::motion("s.csv", {{0.01, 0.7}, {0.004, 1.93}, {0.003, 3.17}}, 6.0, 3000, 0.2);
  sweep.force.assign(sweep.size(), 1.0);
  EXPECT_EQ(periodicity(sweep).period, 0.0);
}

// A sine of 1.5 Hz whose amplitude follows an envelope in [0, 1] of time, and the force of a yielding damper on it with
// noise of 8 N whose neighbours correlate by `correlation`; 6000 samples over 12 s.
constexpr double noise_size = 8.0;

Recording enveloped(const std::function<double(double)>& envelope, double correlation, std::uint64_t draw) {
  Recording recording;
  const Stream stream = Stream(draw).child("enveloped");
  for (std::size_t n = 0; n < 6000; ++n) {
    const double t = 0.002 * static_cast<double>(n);
    recording.time.push_back(t);
    recording.displacement.push_back(0.01 * envelope(t) * std::sin(3.0 * std::numbers::pi * t));
  }
  recording.velocity = derive_velocity(recording.time, recording.displacement);
  double state = stream.normal(0, 1);
  for (std::size_t n = 0; n < 6000; ++n) {
    state = correlation * state + std::sqrt(1.0 - correlation * correlation) * stream.normal(n);
    const double v = recording.velocity[n];
    recording.force.push_back(800.0 * std::tanh(v / 0.02) + 2000.0 * v + noise_size * state);
  }
  return recording;
}

double ramps(double t) { return std::clamp(std::min(t / 3.0, (12.0 - t) / 3.0), 0.0, 1.0); }

// Relative standard error of the deviation of so many seconds of such noise, every period but two compared twice: the
// squares of an AR(1) process are worth (1 - r^2) / (1 + r^2) values each.
double expected_error(double seconds, double correlation) {
  const double square = correlation * correlation;
  const double worth = seconds / 0.002 * (1.0 - square) / (1.0 + square);
  return std::sqrt(1.5 / (2.0 * worth));
}

TEST(NoiseFloor, OfARampedSineIsThatOfItsSteadyCycles) {
  for (const double correlation : {0.0, 0.9}) {
    double sum = 0.0;
    for (std::uint64_t draw = 1; draw <= 8; ++draw) {
      const NoiseFloor floor = noise_floor(enveloped(ramps, correlation, draw));
      ASSERT_EQ(floor.method, NoiseMethod::cycles);
      // Six seconds are steady, of which the first half period does not count.
      EXPECT_NEAR(floor.cycles, 9.0 - 0.5, 0.6);
      EXPECT_NEAR(floor.sigma, noise_size, 4.0 * expected_error(5.0, correlation) * noise_size) << correlation;
      sum += floor.sigma / 8.0;
    }
    EXPECT_NEAR(sum, noise_size, 2.0 * expected_error(5.0, correlation) * noise_size) << correlation;
  }
}

TEST(NoiseFloor, OfAMotionThatStopsIsThatOfTheMotion) {
  const auto stops = [](double t) { return t < 4.0 ? 1.0 : 0.0; };
  const NoiseFloor floor = noise_floor(enveloped(stops, 0.0, 3));
  ASSERT_EQ(floor.method, NoiseMethod::cycles);
  EXPECT_NEAR(floor.cycles, 6.0 - 0.5, 0.6);
  EXPECT_NEAR(floor.sigma, noise_size, 4.0 * expected_error(3.3, 0.0) * noise_size);
}

TEST(NoiseFloor, OfTwoAmplitudesIsThatOfTheLongerStretch) {
  const auto two = [](double t) { return t < 14.0 / 3.0 ? 0.4 : 1.0; };
  const Recording recording = enveloped(two, 0.0, 5);
  const NoiseFloor floor = noise_floor(recording);
  ASSERT_EQ(floor.method, NoiseMethod::cycles);
  EXPECT_NEAR(floor.cycles, 11.0 - 0.5, 0.6);
  EXPECT_NEAR(floor.sigma, noise_size, 4.0 * expected_error(6.5, 0.0) * noise_size);
  EXPECT_NEAR(periodicity(recording).period, 2.0 / 3.0, 1e-4);
}

TEST(NoiseFloor, FadingForceIsNoNoise) {
  Recording recording = enveloped(ramps, 0.0, 7);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.force[n] *= 1.0 + 0.3 * std::exp(-recording.time[n] / 4.0);
    recording.force[n] += 20.0 * recording.time[n];
  }
  // The noise fades with the rest: by 30 to 1.5 %, 8 % in the middle.
  EXPECT_NEAR(noise_floor(recording).sigma, 1.08 * noise_size, 4.0 * expected_error(5.0, 0.0) * noise_size);
}

TEST(NoiseFloor, OfAMotionThatNeverRepeatsIsHighPass) {
  EXPECT_EQ(noise_floor(noisy(10.0, 0.0, 0.0, seed, {{0.01, 0.7}, {0.004, 1.93}, {0.003, 3.17}})).method,
            NoiseMethod::high_pass);
  EXPECT_EQ(noise_floor(enveloped([](double t) { return t / 12.0; }, 0.0, 1)).method, NoiseMethod::high_pass)
      << "a ramp that never ends";
}

// A drive that steps out of time with the motion changes the force from period to period: that is no noise.
TEST(NoiseFloor, WhatAVaryingDriveChangesIsNoNoise) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  recording.drive_kind = DriveKind::current;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double drive = std::fmod(recording.time[n], 0.34) < 0.17 ? 0.2 : 1.0;
    recording.force[n] += 600.0 * drive * std::tanh(recording.velocity[n] / 0.02);
    recording.drive.push_back(drive);
  }
  const NoiseFloor floor = noise_floor(recording);
  EXPECT_EQ(floor.method, NoiseMethod::high_pass);
  EXPECT_NEAR(floor.sigma, 10.0, 1.5);
  // In time with the motion it repeats, and so does the force.
  recording = noisy(10.0, 0.0, 0.0);
  recording.drive_kind = DriveKind::current;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double drive = std::fmod(recording.time[n], 0.5) < 0.25 ? 0.2 : 1.0;
    recording.force[n] += 600.0 * drive * std::tanh(recording.velocity[n] / 0.02);
    recording.drive.push_back(drive);
  }
  EXPECT_EQ(noise_floor(recording).method, NoiseMethod::cycles);
  EXPECT_NEAR(noise_floor(recording).sigma, 10.0, 1.5);
}

TEST(NoiseFloor, OfFewSamplesIsUnknown) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  for (std::vector<double>* channel : channels_of(recording)) {
    if (!channel->empty()) channel->resize(8);
  }
  EXPECT_EQ(noise_floor(recording).method, NoiseMethod::unknown);
}

TEST(Structure, NoiseOfAnyColourCannotBePredicted) {
  for (const double correlation : {0.0, 0.9, 0.98}) {
    double sum = 0.0;
    for (std::uint64_t draw = 1; draw <= 10; ++draw) {
      const Recording recording = noisy(0.0, 10.0, correlation, draw);
      std::vector<double> residual(recording.size());
      for (std::size_t n = 0; n < recording.size(); ++n) {
        residual[n] =
            recording.force[n] - 800.0 * std::tanh(recording.velocity[n] / 0.02) - 2000.0 * recording.velocity[n];
      }
      const double share = predictable_share(recording, residual);
      sum += share;
      // Few independent values make chance agreement possible, which the verdict's threshold of 0.1 allows for.
      EXPECT_LT(share, 0.1) << "correlation " << correlation << ", seed " << draw;
    }
    EXPECT_LT(sum / 10.0, 0.01) << "correlation " << correlation;
  }
}

TEST(Structure, WhatIsLockedToTheMotionIsPredicted) {
  const Recording recording = noisy(0.0, 0.0, 0.0);
  const Stream stream = Stream(seed);
  std::vector<double> residual(recording.size());
  for (std::size_t n = 0; n < recording.size(); ++n) {
    residual[n] =
        5.0 * std::copysign(1.0, recording.velocity[n]) * recording.displacement[n] / 0.01 + 2.0 * stream.normal(n);
  }
  // Of 25/2 + 4 the first part repeats.
  EXPECT_NEAR(predictable_share(recording, residual), 12.5 / 16.5, 0.1);
}

// A motion that repeats itself, and one that does not.
const std::vector<testing::Tone> sine = {{0.01, 2.0}};
const std::vector<testing::Tone> various = {{0.01, 0.7}, {0.004, 1.93}, {0.003, 3.17}};

Evenness evenness_of(const Recording& recording, const std::vector<double>& residual) {
  EvennessSum sum;
  sum.add(recording, Residual{residual, 0}, 1.0);
  return sum.result();
}

TEST(Evenness, OneNoiseInTwentyFollowsTheMotionByChance) {
  for (const auto& [correlation, tones] :
       {std::pair{0.0, various}, std::pair{0.9, various}, std::pair{0.0, sine}, std::pair{0.9, sine}}) {
    int odd = 0;
    for (std::uint64_t draw = 1; draw <= 40; ++draw) {
      const Recording recording = noisy(0.0, 10.0, correlation, draw, tones);
      const Recording quiet = noisy(0.0, 0.0, 0.0, draw, tones);
      std::vector<double> residual(recording.size());
      for (std::size_t n = 0; n < residual.size(); ++n) {
        residual[n] = recording.force[n] - quiet.force[n];
      }
      odd += even(evenness_of(quiet, residual)) ? 0 : 1;
    }
    // Two are expected of forty; seven or more come once in two hundred times.
    EXPECT_LT(odd, 7) << correlation;
  }
}

TEST(Evenness, WhatGrowsWithTheSpeedFollowsTheMotion) {
  for (const std::vector<testing::Tone>& tones : {various, sine}) {
    const Recording recording = noisy(0.0, 0.0, 0.0, seed, tones);
    const Stream stream = Stream(3);
    std::vector<double> residual(recording.size());
    for (std::size_t n = 0; n < residual.size(); ++n) {
      residual[n] = (0.05 + std::fabs(recording.velocity[n])) * stream.normal(n);
    }
    EXPECT_TRUE(uneven(evenness_of(recording, residual))) << tones.size();
  }
}

TEST(Evenness, TooFewSamplesSayNothing) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  for (std::vector<double>* channel : channels_of(recording)) {
    if (!channel->empty()) channel->resize(100);
  }
  EXPECT_FALSE(even(evenness_of(recording, recording.force)));
  EXPECT_FALSE(uneven(evenness_of(recording, recording.force)));
}

TEST(Shaken, AddsAsMuchNoiseAsTheMotionHolds) {
  Recording recording = noisy(1.0, 0.0, 0.0);
  const Stream stream = Stream(5);
  const double of_displacement = 2e-6;
  const double of_velocity = 3e-4;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.displacement[n] += of_displacement * stream.normal(n);
    recording.velocity[n] += of_velocity * stream.normal(n, 1);
  }
  const Recording other = shaken(recording);
  double x = 0.0;
  double v = 0.0;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    x += std::pow(other.displacement[n] - recording.displacement[n], 2);
    v += std::pow(other.velocity[n] - recording.velocity[n], 2);
  }
  const auto count = static_cast<double>(recording.size());
  EXPECT_NEAR(std::sqrt(x / count), of_displacement, 0.1 * of_displacement);
  EXPECT_NEAR(std::sqrt(v / count), of_velocity, 0.1 * of_velocity);
  EXPECT_EQ(other.force, recording.force);
}

}  // namespace
}  // namespace hysteron
