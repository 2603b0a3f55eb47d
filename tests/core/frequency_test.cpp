#include "core/frequency.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Frequency, OfARampedSineIsThatOfItsSteadyPart) {
  Recording recording = sine(1.4, 80.0, 3.0);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.displacement[n] *= std::min(1.0, recording.time[n] / 0.8);
  }
  EXPECT_NEAR(dominant_frequency(recording), 1.4, 0.02);
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
