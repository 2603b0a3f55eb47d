// The sine fitted to a displacement: exact without noise, and as exact as theory allows with it.
#include "study/sine_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr double amplitude = 0.0025;
constexpr double frequency = 1.3;

Recording sine(double phase, double noise, double middle, std::size_t count, double rate) {
  Recording recording;
  recording.file = "sine.csv";
  const Stream stream = Stream(3).child("sine");
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < count; ++n) {
    const double t = static_cast<double>(n) / rate;
    recording.time.push_back(t);
    recording.displacement.push_back(middle + amplitude * std::sin(omega * t + phase) + noise * stream.normal(n));
    recording.velocity.push_back(amplitude * omega * std::cos(omega * t + phase));
    recording.force.push_back(0.0);
  }
  return recording;
}

double turned(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

TEST(SineFit, IsExactWithoutNoise) {
  for (const double phase : {0.0, 0.4, 1.5, 2.9, 4.4, 6.1}) {
    const SineFit fit = fit_sine(sine(phase, 0.0, 0.004, 400, 100.0));
    // The middle is that of the extremes among the samples.
    EXPECT_NEAR(fit.amplitude / amplitude, 1.0, 1e-3) << phase;
    EXPECT_NEAR(fit.frequency / frequency, 1.0, 1e-4) << phase;
    EXPECT_NEAR(turned(fit.phase - phase), 0.0, 2e-3) << phase;
    EXPECT_LT(fit.rms, 2e-3 * amplitude) << phase;
  }
}

// Cramer-Rao for a sine among N samples of white noise s: var(A) = 2 s^2 / N, var(phase) = 8 s^2 / (N A^2),
// var(2 pi f) = 24 s^2 / (N A^2 T^2). Four standard deviations.
TEST(SineFit, IsAsExactAsTheNoiseAllows) {
  constexpr std::size_t count = 2000;
  constexpr double rate = 200.0;
  const double noise = 0.05 * amplitude;
  const SineFit fit = fit_sine(sine(0.7, noise, 0.0, count, rate));
  const double share = noise / amplitude / std::sqrt(static_cast<double>(count));
  EXPECT_LT(std::fabs(fit.amplitude / amplitude - 1.0), 4.0 * std::sqrt(2.0) * share);
  // The middle of noisy extremes is off by about a third of the noise, which the sine does not take up.
  EXPECT_LT(std::fabs(turned(fit.phase - 0.7)), 4.0 * std::sqrt(8.0) * share);
  EXPECT_LT(std::fabs(fit.frequency - frequency),
            4.0 * std::sqrt(24.0) * share / (2.0 * std::numbers::pi * static_cast<double>(count) / rate));
}

// Of a long recording a frequency off by a hundredth is whole periods away.
TEST(SineFit, FindsTheFrequencyOfALongRecording) {
  const SineFit fit = fit_sine(sine(2.0, 0.02 * amplitude, 0.0, 3000, 60.0));
  EXPECT_NEAR(fit.frequency / frequency, 1.0, 1e-5);
  EXPECT_NEAR(fit.amplitude / amplitude, 1.0, 3e-3);
}

TEST(SineFit, PutsItsMotionInPlaceOfTheRecorded) {
  const Recording recording = sine(0.7, 0.02 * amplitude, 0.0, 500, 100.0);
  const SineFit fit = fit_sine(recording);
  const Recording clean = with_motion_of(fit, recording);
  const double omega = 2.0 * std::numbers::pi * fit.frequency;
  for (std::size_t n = 0; n < clean.size(); n += 17) {
    const double x = clean.displacement[n];
    EXPECT_NEAR(clean.derived_acceleration[n], -omega * omega * x, 1e-9);
    EXPECT_NEAR(clean.velocity[n] * clean.velocity[n] / (omega * omega) + x * x, fit.amplitude * fit.amplitude, 1e-12);
  }
}

TEST(SineFit, RefusesAMotionWithoutAPeriod) {
  Recording recording = sine(0.0, 0.0, 0.0, 10, 100.0);
  EXPECT_THROW(static_cast<void>(fit_sine(recording)), InputError);
}

}  // namespace
}  // namespace hysteron
