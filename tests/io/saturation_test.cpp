// A force that is cut off behind its noise, and what yields at one value without being so.
#include "io/saturation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/clipped_ends.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr double amplitude = 0.01;

using Change = std::function<double(double force)>;
double whole(double force) { return force; }
Change cut_at(double low, double high) {
  return [=](double force) { return std::clamp(force, low, high); };
}
Change in_steps(double step) {
  return [=](double force) { return step * std::round(force / step); };
}

// A force that saturates smoothly at 460 N, 6 s at 250 Hz, 1 Hz, under noise of `noise` before `change`.
Recording damper(double noise, const Change& change, double level = 460.0) {
  const Stream stream(11);
  Recording one;
  for (std::uint64_t n = 0; n < 1500; ++n) {
    const double t = 0.004 * static_cast<double>(n);
    const double omega = 2.0 * std::numbers::pi;
    one.time.push_back(t);
    one.displacement.push_back(amplitude * std::sin(omega * t) + 1e-6 * stream.normal(5000 + n));
    one.force.push_back(change(level * std::tanh(3.0 * std::cos(omega * t)) + noise * stream.normal(n)));
  }
  one.velocity = derive_velocity(one.time, one.displacement);
  return one;
}

// Elastic elements in parallel that yield at 100 N each, all of them in the end, on the motion as it was measured.
Recording friction(double motion_noise, double force_noise) {
  const Stream stream(12);
  Recording one;
  std::vector<double> elements(4, 0.0);
  double before = 0.0;
  for (std::uint64_t n = 0; n < 1500; ++n) {
    const double t = 0.004 * static_cast<double>(n);
    const double x = amplitude * std::sin(2.0 * std::numbers::pi * t) + motion_noise * stream.normal(n);
    double force = 0.0;
    double stiffness = 2e4;
    for (double& element : elements) {
      element = std::clamp(element + stiffness * (x - before), -100.0, 100.0);
      force += element;
      stiffness *= 1.7;
    }
    before = x;
    one.time.push_back(t);
    one.displacement.push_back(x);
    one.force.push_back(force + force_noise * stream.normal(5000 + n));
  }
  one.velocity = derive_velocity(one.time, one.displacement);
  return one;
}

TEST(Saturation, OfAForceThatIsCutWithItsNoise) {
  struct Case {
    double low;
    double high;
    std::size_t ends;
  };
  for (const Case& one : {Case{-430.0, 430.0, 2}, {-380.0, 380.0, 2}, {-459.0, 459.0, 2}, {-1000.0, 440.0, 1}}) {
    for (const Change& digits : {Change(whole), in_steps(1e-3), in_steps(0.5)}) {
      const Change cut = cut_at(one.low, one.high);
      const auto ends = saturated_ends_of_force(damper(4.0, [&](double force) { return cut(digits(force)); }));
      ASSERT_EQ(ends.size(), one.ends) << one.high << " " << digits(0.3);
      EXPECT_EQ(ends.front().value, one.high);
    }
  }
}

// The corner between few samples is as rough as noise, and not everywhere.
TEST(Saturation, NoneOfAFrictionThatIsSimulatedWithoutNoise) {
  for (const int samples : {50, 100, 200}) {
    for (const int periods : {3, 8, 20}) {
      Recording one;
      for (int n = 0; n < samples * periods; ++n) {
        const double phase = 2.0 * std::numbers::pi * n / samples + 0.1;
        one.time.push_back(static_cast<double>(n) / samples);
        one.displacement.push_back(amplitude * std::sin(phase));
        one.force.push_back(200.0 * std::tanh(2.0 * std::numbers::pi * amplitude * std::cos(phase) / 1e-3));
      }
      one.velocity = derive_velocity(one.time, one.displacement);
      EXPECT_TRUE(saturated_ends_of_force(one).empty()) << samples << " " << periods;
    }
  }
}

// It is in the remark on the file.
TEST(Saturation, IsAFlatEnd) {
  const Recording cut = damper(4.0, cut_at(-455.0, 455.0));
  const auto end = flat_end_of(cut.force);
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(std::fabs(end->value), 455.0);
  EXPECT_TRUE(end->in_noise);
}

TEST(Saturation, NoneOfNoiseInAnySteps) {
  for (const double step : {1e-3, 0.5, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    for (const double noise : {0.0, 0.2, 1.0, 4.0, 10.0}) {
      EXPECT_TRUE(saturated_ends_of_force(damper(noise, in_steps(step))).empty()) << step << " " << noise;
    }
  }
}

TEST(Saturation, NoneOfAFrictionThatYields) {
  EXPECT_TRUE(saturated_ends_of_force(friction(0.0, 0.0)).empty()) << "without noise";
  EXPECT_TRUE(saturated_ends_of_force(friction(0.0, 1.0)).empty()) << "under its noise";
  for (const double noise : {1e-6, 1e-5, 5e-5}) {
    EXPECT_TRUE(saturated_ends_of_force(friction(noise, 0.0)).empty()) << "simulated on a noise of " << noise;
  }
  // Without looking at the motion it would be one.
  const Recording simulated = friction(1e-5, 0.0);
  EXPECT_TRUE(saturated_end_of(simulated.force, 1.0).has_value());
  EXPECT_TRUE(force_noise_is_of_motion(simulated));
  EXPECT_FALSE(force_noise_is_of_motion(damper(4.0, cut_at(-430.0, 430.0))));
}

TEST(Saturation, IsToldOfACampaign) {
  std::vector<Recording> recordings;
  for (const double level : {300.0, 460.0, 470.0}) recordings.push_back(damper(4.0, cut_at(-440.0, 440.0), level));
  const auto clippings = clipping_of(recordings);
  ASSERT_EQ(clippings.size(), 1U);
  const std::string said = sentence_of(clippings.front(), recordings.size());
  EXPECT_TRUE(
      said.starts_with("the force rests at 440 and -440 N, the ends of its range, in 2 of 3 recordings, for up "
                       "to "))
      << said;
  // One is enough, and is not told of others.
  recordings = {recordings[1]};
  const auto alone = clipping_of(recordings);
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(sentence_of(alone.front(), 1).find("recordings"), std::string::npos);
  EXPECT_TRUE(clipping_of({damper(4.0, whole)}).empty());
}

}  // namespace
}  // namespace hysteron
