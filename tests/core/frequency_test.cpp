#include "core/frequency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace hysteron {
namespace {

Recording sine(double hertz, double rate, double seconds) {
  Recording recording;
  for (int n = 0; n <= static_cast<int>(rate * seconds); ++n) {
    recording.time.push_back(n / rate);
    recording.displacement.push_back(2e-3 * std::sin(2.0 * std::numbers::pi * hertz * recording.time.back()));
  }
  return recording;
}

// Twenty-one samples a period, so that a half period is no whole number of them, and ten, where crests lie between two.
TEST(Frequency, IsNotRoundedToSamples) {
  for (const double hertz : {4.0, 22.5, 24.0, 50.0}) {
    EXPECT_NEAR(dominant_frequency(sine(hertz, 500.0, 3.0)), hertz, 1e-3 * hertz);
  }
}

// Half a period turns once, nine tenths of one turn twice.
TEST(Frequency, IsNotToldByOneTurn) {
  const Recording half = sine(0.3, 100.0, 0.5 / 0.3);
  EXPECT_EQ(dominant_frequency(half), 0.0);
  EXPECT_TRUE(turns_once(half));
  EXPECT_FALSE(turns_once(sine(0.3, 100.0, 0.9 / 0.3)));
  EXPECT_FALSE(turns_once(sine(0.3, 100.0, 0.2 / 0.3))) << "a motion that does not turn is slow";
}

TEST(Frequency, OfARampedSineIsThatOfItsSteadyPart) {
  Recording recording = sine(1.4, 80.0, 3.0);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.displacement[n] *= std::min(1.0, recording.time[n] / 0.8);
  }
  EXPECT_NEAR(dominant_frequency(recording), 1.4, 0.02);
}

// What is added turns the motion between its own turns, so that these tell nothing of it.
TEST(Frequency, IsThatOfTheStrongestTone) {
  struct Beside {
    double share, multiple, phase;
  };
  for (const Beside beside : {Beside{0.1, 7.0, 0.0}, {0.2, 7.0, 0.0}, {0.3, 3.0, 0.0}, {0.3, 5.3, 0.4}}) {
    for (const double rate : {500.0, 2000.0}) {
      Recording recording = sine(4.0, rate, 6.0);
      const Recording other = sine(4.0 * beside.multiple, rate, 6.0);
      const auto late = static_cast<std::size_t>(beside.phase * 0.01 * rate);
      for (std::size_t n = 0; n + late < recording.size(); ++n) {
        recording.displacement[n] += beside.share * other.displacement[n + late];
      }
      EXPECT_NEAR(dominant_frequency(recording), 4.0, 4e-3) << beside.share << " of " << beside.multiple;
    }
  }
}

TEST(Frequency, OfANoisySineIsThatOfTheSine) {
  Recording recording = sine(0.5, 500.0, 6.0);
  std::uint32_t state = 1;
  for (double& x : recording.displacement) {
    state = 1664525U * state + 1013904223U;
    x += 4e-4 * (static_cast<double>(state) / 4294967296.0 - 0.5);
  }
  EXPECT_NEAR(dominant_frequency(recording), 0.5, 5e-3);
}

// The period of a motion whose two strokes take unequal times, or that rests between them.
TEST(Frequency, OfUnequalStrokesIsThatOfWholePeriods) {
  constexpr double hertz = 0.8;
  const auto smooth = [](double share) { return 0.5 - 0.5 * std::cos(std::numbers::pi * share); };
  const auto stroke = [](double part, double up, double hold) {  // of a period: up, held, down, held
    if (part < up) return part / up;
    if (part < up + hold) return 1.0;
    return std::max(0.0, 1.0 - (part - up - hold) / (0.2 - 0.5 * std::min(up, 0.2)));
  };
  const auto of = [&](double rate, auto&& displacement) {
    Recording recording = sine(hertz, rate, 12.0);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.displacement[n] = 0.01 * displacement(std::fmod(recording.time[n] * hertz + 0.3, 1.0));
    }
    return dominant_frequency(recording);
  };
  for (const double rate : {50.0, 400.0}) {
    for (const double up : {0.8, 0.9}) {
      EXPECT_NEAR(of(rate, [&](double p) { return p < up ? p / up : (1.0 - p) / (1.0 - up); }), hertz, 2e-3) << up;
      EXPECT_NEAR(of(rate, [&](double p) { return smooth(p < up ? p / up : (1.0 - p) / (1.0 - up)); }), hertz, 2e-3);
    }
    EXPECT_NEAR(of(rate, [&](double p) { return p < 0.5 ? smooth(4.0 * std::min(p, 0.5 - p)) : 0.0; }), hertz, 2e-3);
    EXPECT_NEAR(of(rate, [&](double p) { return stroke(p, 0.1, 0.6); }), hertz, 2e-3) << "held twice";
    EXPECT_NEAR(of(rate,
                   [&](double p) {
                     const double phase = 2.0 * std::numbers::pi * p;
                     return std::sin(phase) + 0.4 * std::sin(2.0 * phase);
                   }),
                hertz, 2e-3);
  }
}

TEST(Frequency, OfASineOnADriftIsThatOfTheSine) {
  for (const double per_second : {0.1, 0.5, 1.5}) {  // of the amplitude
    Recording recording = sine(1.0, 200.0, 20.0);
    for (std::size_t n = 0; n < recording.size(); ++n)
      recording.displacement[n] += 2e-3 * per_second * recording.time[n];
    EXPECT_NEAR(dominant_frequency(recording), per_second > 1.0 ? 0.0 : 1.0, 2e-3) << per_second;
  }
}

// No sine is most of a sweep: its frequency stays one that it turns with.
TEST(Frequency, OfASweepIsThatOfItsTurns) {
  Recording recording = sine(1.0, 500.0, 20.0);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double t = recording.time[n];
    recording.displacement[n] = 2e-3 * std::sin(2.0 * std::numbers::pi * (0.5 * t + 0.1 * t * t));
  }
  EXPECT_GT(dominant_frequency(recording), 2.0);
}

TEST(Frequency, OfWhatNeverTurnsIsZero) {
  Recording recording;
  for (int n = 0; n < 100; ++n) {
    recording.time.push_back(0.01 * n);
    recording.displacement.push_back(1e-3 * n);
  }
  EXPECT_EQ(dominant_frequency(recording), 0.0);
  EXPECT_EQ(dominant_frequency(Recording{}), 0.0);
}

}  // namespace
}  // namespace hysteron
