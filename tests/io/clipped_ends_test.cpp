// A channel that ends before its signal does, whatever noise is on it, and what of dampers and rods looks like it.
#include "io/clipped_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/random.hpp"

namespace hysteron {
namespace {

struct Test {
  double amplitude;  // m
  double frequency;  // Hz
  double current;    // A
};
const std::vector<Test> tests = {
    {0.02, 1.0, 0.0}, {0.02, 1.0, 1.0}, {0.01, 2.0, 0.5}, {0.015, 1.5, 0.8}, {0.005, 3.0, 0.2}};

using Force = std::function<double(double displacement, double velocity, double current)>;
using Ends = std::function<double(double value)>;
double whole(double value) { return value; }
double viscous(double displacement, double velocity, double current) {
  return (1200.0 + 900.0 * current) * velocity + 3000.0 * displacement;
}

// 4 s at 500 Hz, of the force noise of 1 N before it ends and of 0.5 N behind, of the displacement 1 um.
std::vector<Recording> campaign_of(const Force& force, const Ends& force_end, const Ends& displacement_end = whole) {
  std::vector<Recording> result;
  for (const auto& test : tests) {
    const Stream noise(result.size());
    Recording one;
    one.drive_kind = DriveKind::current;
    for (std::uint64_t n = 0; n < 2000; ++n) {
      const double omega = 2.0 * std::numbers::pi * test.frequency;
      const double t = 0.002 * static_cast<double>(n);
      const double x = test.amplitude * std::sin(omega * t);
      const double v = test.amplitude * omega * std::cos(omega * t);
      one.time.push_back(t);
      one.displacement.push_back(displacement_end(x) + 1e-6 * noise.normal(n));
      one.velocity.push_back(v);
      one.force.push_back(force_end(force(x, v, test.current) + noise.normal(5000 + n)) +
                          0.5 * noise.normal(10000 + n));
      one.drive.push_back(test.current);
    }
    result.push_back(one);
  }
  return result;
}

TEST(ClippedEnds, OfAForceUnderNoise) {
  const auto both = clipping_of(campaign_of(viscous, [](double f) { return std::clamp(f, -180.0, 180.0); }));
  ASSERT_EQ(both.size(), 1U);
  ASSERT_EQ(both.front().ends.size(), 2U);
  EXPECT_NEAR(both.front().ends[0].level, 180.0, 0.2);
  EXPECT_NEAR(both.front().ends[1].level, -180.0, 0.2);
  EXPECT_EQ(both.front().ends[0].recordings, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(sentence_of(both.front(), 5).find("the force rests at 180 and -180 N, the ends of its range, in 3 of 5 "),
            0U);

  const auto one = clipping_of(campaign_of(viscous, [](double f) { return std::max(f, -150.0); }));
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(one.front().ends.size(), 1U);
  EXPECT_NEAR(one.front().ends[0].level, -150.0, 0.2);
}

TEST(ClippedEnds, OfADisplacementUnderNoise) {
  const auto found = clipping_of(campaign_of(viscous, whole, [](double x) { return std::min(x, 0.018); }));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().channel, &Recording::displacement);
  ASSERT_EQ(found.front().ends.size(), 1U);
  EXPECT_NEAR(found.front().ends[0].level, 0.018, 1e-6);
}

TEST(ClippedEnds, AForceThatYieldsAtOneLevelIsWhole) {
  const auto friction = [](double, double v, double) { return 200.0 * std::tanh(1e3 * v); };
  EXPECT_TRUE(clipping_of(campaign_of(friction, whole)).empty());
  const auto by_current = [](double, double v, double i) { return (100.0 + 300.0 * i) * std::tanh(1e3 * v); };
  EXPECT_TRUE(clipping_of(campaign_of(by_current, whole)).empty());
  EXPECT_TRUE(clipping_of(campaign_of(viscous, whole)).empty());
}

// Of few samples and no noise the jumps of friction are its roughness, and the last sample at its level is at full
// speed. Three recordings of another setting do not make the others saturate.
TEST(ClippedEnds, FrictionThatIsSimulatedIsWhole) {
  const std::vector<Force> laws = {
      [](double, double v, double) { return v > 0.0 ? 200.0 : -200.0; },
      [](double, double v, double) { return 200.0 * std::tanh(1e3 * v); },
      [](double, double v, double i) { return (i > 0.6 ? 200.0 : 120.0) * std::tanh(1e3 * v) + 5.0 * v; }};
  for (std::size_t law = 0; law < laws.size(); ++law) {
    for (const double samples : {13.0, 17.0, 20.0, 50.0, 100.0}) {
      for (const double noise : {0.0, 1e-3, 0.5}) {
        std::vector<Recording> recordings;
        for (const auto& test : tests) {
          const Stream stream(recordings.size());
          Recording one;
          one.drive_kind = DriveKind::current;
          for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(8 * samples); ++n) {
            const double phase = 2.0 * std::numbers::pi * static_cast<double>(n) / samples + 0.1;
            const double speed = test.amplitude * 2.0 * std::numbers::pi * test.frequency;
            one.time.push_back(static_cast<double>(n) / samples / test.frequency);
            one.displacement.push_back(test.amplitude * std::sin(phase));
            one.velocity.push_back(speed * std::cos(phase));
            one.force.push_back(laws[law](one.displacement.back(), one.velocity.back(), test.current) +
                                noise * stream.normal(n));
            one.drive.push_back(test.current);
          }
          recordings.push_back(one);
        }
        EXPECT_TRUE(clipping_of(recordings).empty()) << law << " " << samples << " " << noise;
      }
    }
  }
}

// Without noise as well.
TEST(ClippedEnds, OfAForceWithoutNoise) {
  std::vector<Recording> recordings = campaign_of(viscous, whole);
  for (Recording& one : recordings) {
    for (std::size_t n = 0; n < one.size(); ++n) {
      const double x = one.displacement[n];
      one.force[n] = std::clamp(viscous(x, one.velocity[n], one.drive[n]), -150.0, 150.0);
    }
  }
  const auto found = clipping_of(recordings);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().ends.size(), 2U);
}

// A limit of one direction with a void that is filled without force on the way back.
TEST(ClippedEnds, CavitationIsNoEndOfTheChannel) {
  const double limit = -150.0;
  double opened = 0.0;
  double before = 0.0;
  const auto cavitating = [&](double x, double v, double i) {
    const double whole_force = viscous(x, v, i);
    const double gone = x - before;
    before = x;
    if (whole_force < limit) opened += 0.5 * std::fabs(gone);
    if (whole_force > 0.0 && opened > 0.0) {
      opened -= std::fabs(gone);
      return 0.0;
    }
    return std::max(whole_force, limit);
  };
  EXPECT_TRUE(clipping_of(campaign_of(cavitating, whole)).empty());
}

// A rod that is driven to the same place and rests there.
TEST(ClippedEnds, ARodThatRestsIsNoEndOfItsSensor) {
  std::vector<Recording> recordings = campaign_of(viscous, whole, [](double x) { return std::clamp(x, -0.01, 0.01); });
  for (Recording& one : recordings) {
    for (std::size_t n = 0; n < one.size(); ++n) {
      if (std::fabs(one.displacement[n]) > 0.009999) one.force[n] = 0.0;
    }
  }
  EXPECT_TRUE(clipping_of(recordings).empty());
}

}  // namespace
}  // namespace hysteron
