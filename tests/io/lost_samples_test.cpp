#include "io/lost_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/reread.hpp"

namespace hysteron {
namespace {

using testing::said_of;

using Motion = std::function<double(double time)>;

// 1 Hz, 10 mm.
double sine(double t) { return 0.01 * std::sin(2.0 * std::numbers::pi * t); }
double triangle(double t) { return 0.02 * (2.0 * std::fabs(t - std::round(t)) - 0.5); }
// 40 mm/s for a quarter of a second, and a hold as long.
double ramps_with_holds(double t) {
  const double step = std::floor(2.0 * t);
  return 0.01 * (step + std::min(4.0 * t - 2.0 * step, 1.0));
}

// 2000 samples at 500 Hz with a viscous force, taken `late` by a part of a step each.
Recording taken(
    const Motion& motion, const std::function<double(std::size_t)>& late = [](std::size_t) { return 0.0; }) {
  Recording result;
  for (std::size_t n = 0; n < 2000; ++n) {
    const double t = 0.002 * (static_cast<double>(n) + late(n));
    result.time.push_back(0.002 * static_cast<double>(n));
    result.displacement.push_back(motion(t));
    result.force.push_back(5e3 * (motion(t + 1e-4) - motion(t - 1e-4)) / 2e-4);
  }
  return result;
}

Recording with_noise(Recording result, double deviation) {
  const Stream stream(5);
  for (std::size_t n = 0; n < result.size(); ++n) result.displacement[n] += deviation * stream.normal(n);
  return result;
}

// Of the rows that are left the times are made anew, or kept.
Recording without_rows(const Recording& all, const std::function<bool(std::size_t)>& is_lost, bool even = true) {
  Recording result;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (is_lost(n)) continue;
    result.time.push_back(all.time[even ? result.time.size() : n]);
    result.displacement.push_back(all.displacement[n]);
    result.force.push_back(all.force[n]);
  }
  return result;
}

bool one_of_fifty(std::size_t n) { return Stream(7).uniform(n) < 0.02; }

TEST(LostSamples, AreSeenBelowTheNoiseOfAGap) {
  for (const Motion& motion : {Motion(sine), Motion(triangle), Motion(ramps_with_holds)}) {
    for (const double noise : {5e-7, 2e-6, 4e-6}) {
      const auto lost = lost_samples_of(without_rows(with_noise(taken(motion), noise), one_of_fifty));
      ASSERT_TRUE(lost) << noise;
      EXPECT_NEAR(lost->share, 0.02, 0.01);
    }
  }
  // Two rows side by side, five times.
  const auto lost = lost_samples_of(without_rows(taken(sine), [](std::size_t n) { return n % 500 < 2 && n > 10; }));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->count, 3U);
  EXPECT_EQ(lost->after, 499U);
}

TEST(LostSamples, AreNotOfRowsThatKeptTheirTimes) {
  EXPECT_FALSE(lost_samples_of(without_rows(taken(sine), one_of_fifty, false)));
}

TEST(LostSamples, AreNotOfARecordingWithAllItsRows) {
  for (const Motion& motion : {Motion(sine), Motion(triangle), Motion(ramps_with_holds)}) {
    for (const double noise : {0.0, 2e-6, 2e-5, 2e-4}) {
      EXPECT_FALSE(lost_samples_of(with_noise(taken(motion), noise))) << noise;
    }
    // A converter of 30 and 3000 steps.
    for (const double quantum : {7e-4, 7e-6}) {
      Recording coarse = taken(motion);
      for (double& x : coarse.displacement) x = quantum * std::round(x / quantum);
      EXPECT_FALSE(lost_samples_of(coarse)) << quantum;
    }
  }
}

// A constant speed of a little more than one step of the converter goes by two steps now and then.
TEST(LostSamples, AreNotOfAConverter) {
  for (const double steps : {1.02, 1.1, 2.04, 3.2}) {
    Recording slow = taken(triangle);
    const double quantum = 0.04 * 0.002 / steps;
    for (double& x : slow.displacement) x = quantum * std::round(x / quantum);
    EXPECT_FALSE(lost_samples_of(slow)) << steps;
  }
}

TEST(LostSamples, AreNotOfJitter) {
  const Stream stream(11);
  for (const double part : {0.02, 0.1, 0.3}) {
    EXPECT_FALSE(lost_samples_of(taken(sine, [&](std::size_t n) { return part * stream.normal(n); }))) << part;
  }
  // One sample in fifty is a whole step late, and the next one in time.
  EXPECT_FALSE(lost_samples_of(taken(sine, [](std::size_t n) { return one_of_fifty(n) ? 1.0 : 0.0; })));
  // Rows that are written twice.
  double rows = 0.0;
  EXPECT_FALSE(lost_samples_of(taken(sine, [&](std::size_t n) { return rows -= one_of_fifty(n) ? 1.0 : 0.0; })));
}

TEST(LostSamples, AreTold) {
  EXPECT_TRUE(said_of(taken(sine), "lost samples").empty());
  const auto said = said_of(without_rows(taken(sine), [](std::size_t n) { return n % 100 == 3; }), "lost samples");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(
      said.front(),
      "the displacement goes by two of its steps or more at once in 20 places, first between 0.004 and 0.006 s, "
      "while the times are even: rows that were lost before the times were made, about 1.1 %, look so; speeds come "
      "out too high, and a damping too small by that part or more; keep the times at which the rows were taken");
}

}  // namespace
}  // namespace hysteron
