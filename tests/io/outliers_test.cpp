// Samples that stand out alone are found and replaced; steps, kinks, peaks and noise are none.
#include "io/outliers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace hysteron {
namespace {

// 2 Hz for 6 s at 500 Hz, of a force with a knee; noise of one part white and one coloured.
Recording noisy(double white, double coloured, double correlation) {
  Recording recording;
  const Stream stream = Stream(11);
  double state = 0.0;
  for (std::size_t n = 0; n < 3000; ++n) {
    const double t = 0.002 * static_cast<double>(n);
    const double velocity = 0.04 * std::numbers::pi * std::cos(4.0 * std::numbers::pi * t);
    state = correlation * state + std::sqrt(1.0 - correlation * correlation) * stream.normal(n, 1);
    recording.time.push_back(t);
    recording.force.push_back(800.0 * std::tanh(velocity / 0.02) + 2000.0 * velocity + white * stream.normal(n) +
                              coloured * state);
  }
  return recording;
}

TEST(Outliers, StandAloneAndAreReplaced) {
  const Recording clean = noisy(10.0, 0.0, 0.0);
  Recording recording = clean;
  std::size_t added = 0;
  for (std::size_t n = 50; n + 3 < recording.size(); n += 290, ++added) {
    recording.force[n] += added % 2 == 0 ? 400.0 : -400.0;
  }
  EXPECT_EQ(replace_outliers(recording), added);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    EXPECT_NEAR(recording.force[n], clean.force[n], 80.0) << n;
  }
}

TEST(Outliers, ThatHideEachOtherAreFound) {
  const Recording clean = noisy(10.0, 0.0, 0.0);
  Recording recording = clean;
  std::size_t added = 0;
  for (std::size_t n = 50; n + 10 < recording.size(); n += 290, added += 2) {
    const bool adjacent = added % 4 == 0;
    recording.force[n] += 400.0;
    recording.force[n + (adjacent ? 1 : 2)] += adjacent ? -500.0 : 500.0;
  }
  EXPECT_EQ(replace_outliers(recording), added);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    EXPECT_NEAR(recording.force[n], clean.force[n], 80.0) << n;
  }
}

TEST(Outliers, StepsKinksPeaksAndNoiseAreNone) {
  Recording recording = noisy(5.0, 5.0, 0.9);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.force[n] += (n / 250) % 2 == 0 ? 500.0 : -500.0;                    // steps
    recording.force[n] += 20.0 * std::fabs(static_cast<double>(n % 120) - 60.0);  // kinks
    const double from_peak = std::fabs(static_cast<double>(n % 400) - 200.0);
    recording.force[n] += 800.0 * std::max(0.0, 1.0 - from_peak / 4.0);    // peaks of seven samples
    recording.force[n] += n % 400 == 100 || n % 400 == 101 ? 500.0 : 0.0;  // and of two
  }
  EXPECT_EQ(replace_outliers(recording), 0U);
}

TEST(Outliers, ManyAreHowTheForceIs) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  for (std::size_t n = 20; n + 3 < recording.size(); n += 25) {
    recording.force[n] += 400.0;
  }
  const Recording before = recording;
  EXPECT_EQ(replace_outliers(recording), 0U);
  EXPECT_EQ(recording.force, before.force);
}

// Further than the force spans: no damper does that for two samples, nor at an end of the recording.
TEST(Outliers, TwoSideBySideAndAtAnEndAreSoWhereTheyAreExtreme) {
  for (const double size : {8000.0, 800.0}) {
    Recording recording = noisy(10.0, 0.0, 0.0);
    const Recording clean = recording;
    for (const std::size_t n : {0U, 700U, 701U, 2999U}) recording.force[n] -= size;
    const std::vector<Outlier> found = outliers_of(recording.time, recording.force);
    if (size < 1000.0) {
      EXPECT_TRUE(found.empty());
      continue;
    }
    ASSERT_EQ(found.size(), 4U);
    for (const Outlier& one : found) {
      EXPECT_TRUE(one.extreme);
      EXPECT_NEAR(one.told, clean.force[one.at], 80.0) << one.at;
    }
  }
}

// One of 400 N in a force of 2 kN is replaced, and is nothing to warn of.
TEST(Outliers, AreExtremeWhereTheyGoFurtherThanTheChannelSpans) {
  Recording recording = noisy(10.0, 0.0, 0.0);
  recording.force[700] += 400.0;
  recording.force[1800] += 4000.0;
  const std::vector<Outlier> found = outliers_of(recording.time, recording.force);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].extreme);
  EXPECT_TRUE(found[1].extreme);
}

TEST(Outliers, OfAChannelThatIsConstantOrShortAreNone) {
  Recording recording;
  for (std::size_t n = 0; n < 200; ++n) {
    recording.time.push_back(static_cast<double>(n));
    recording.force.push_back(n == 100 ? 5.0 : 0.0);
  }
  EXPECT_TRUE(outliers_of(recording.time, recording.force).empty());
  EXPECT_TRUE(outliers_of({}, {}).empty());
}

}  // namespace
}  // namespace hysteron
