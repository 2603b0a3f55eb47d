// Held rods are found in noise, and nothing else is.
#include "io/stillness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr double rate = 1000.0;
constexpr double noise = 2e-6;

struct Channel {
  std::vector<double> time;
  std::vector<double> x;
};

Channel channel(const std::function<double(double)>& place, double seconds, std::uint64_t seed, double quantum = 0.0) {
  const Stream stream(seed);
  Channel result;
  for (int n = 0; n < static_cast<int>(rate * seconds); ++n) {
    const double t = n / rate;
    const double x = place(t) + (quantum > 0.0 ? 0.0 : noise * stream.normal(static_cast<std::uint64_t>(n)));
    result.time.push_back(t);
    result.x.push_back(quantum > 0.0 ? quantum * std::round(x / quantum) : x);
  }
  return result;
}

double sine(double t) { return 0.01 * std::sin(2.0 * std::numbers::pi * 2.0 * t); }

// Two seconds of a sine, stopped within 50 ms, then held for half a second.
double stopped(double t) {
  constexpr double stop = 2.04;
  constexpr double stopping = 0.05;
  if (t < stop) return sine(t);
  const double u = std::min((t - stop) / stopping, 1.0);
  return sine(stop + stopping * (u - u * u * u + 0.5 * u * u * u * u));
}

std::vector<Still> stretches(const Channel& of) { return still_stretches(of.time, of.x); }

TEST(Stillness, AHeldRodIsFoundWhereItIsHeld) {
  int found = 0;
  constexpr int seeds = 100;
  for (int seed = 1; seed <= seeds; ++seed) {
    const std::vector<Still> still = stretches(channel(stopped, 2.65, static_cast<std::uint64_t>(seed)));
    if (still.size() != 1) continue;
    // The motion is below the noise in the last milliseconds before it ends.
    EXPECT_GE(still[0].first, 2070U);
    found += still[0].first < 2130 && still[0].end == 2650 ? 1 : 0;
  }
  EXPECT_GE(found, 90);
}

// One sample of a hundred or two is further off than three standard deviations, wherever it lies.
TEST(Stillness, OneSampleOffDoesNotEndIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Channel with = channel(stopped, 2.65, seed);
    const std::vector<Still> before = stretches(with);
    if (before.size() != 1) continue;
    // Behind the stop, in front of the first of three blocks that tell it.
    const std::size_t at = before[0].first + 4;
    with.x[at] = stopped(2.6) + 4.0 * noise;
    const std::vector<Still> after = stretches(with);
    ASSERT_EQ(after.size(), 1U) << seed;
    EXPECT_LE(after[0].first, at) << seed;
    EXPECT_EQ(after[0].end, before[0].end) << seed;
  }
}

TEST(Stillness, MotionIsNotTakenForStillness) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_TRUE(stretches(channel(sine, 3.0, seed)).empty());
    // Ramps from far above the noise of a block to a hundredth of it a block.
    for (const double share : {30.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01}) {
      const double speed = share * noise * rate / 16.0;
      EXPECT_TRUE(stretches(channel([&](double t) { return speed * t; }, 20.0, seed)).empty()) << share;
    }
  }
  // Steps of a quantised ramp stand still for a tenth of a second each.
  EXPECT_TRUE(stretches(channel([](double t) { return 1e-4 * t; }, 5.0, 1, 1e-5)).empty());
}

TEST(Stillness, ChannelsWithoutNoiseOrMotionAndShortOnesSayNothing) {
  Channel exact = channel(stopped, 2.65, 1);
  std::ranges::fill(exact.x, 0.0);
  EXPECT_TRUE(stretches(exact).empty());
  EXPECT_TRUE(stretches(channel(stopped, 0.04, 1)).empty());
  // Of a channel of nothing but noise it is not known what is noise.
  EXPECT_TRUE(stretches(channel([](double) { return 0.003; }, 1.0, 1)).empty());
}

TEST(Stillness, AMeasuredVelocityKeepsWhatIsMotionByItsOwnNoise) {
  const Channel of = channel(stopped, 2.65, 3);
  constexpr double of_velocity = 1e-3;
  const Stream stream(9);
  Recording recording;
  recording.time = of.time;
  recording.displacement = of.x;
  recording.velocity_measured = true;
  // Late by 20 ms: it comes to rest after the displacement has.
  for (std::size_t n = 0; n < of.time.size(); ++n) {
    const double t = of.time[n] - 0.02;
    recording.velocity.push_back((stopped(t + 1e-6) - stopped(t - 1e-6)) / 2e-6 + of_velocity * stream.normal(n));
  }
  const std::vector<double> before = recording.velocity;
  hold_still(recording);
  double tail = 0.0;
  for (std::size_t n = 2085; n < 2105; ++n) tail = std::max(tail, std::fabs(recording.velocity[n]));
  EXPECT_GT(tail, 10.0 * of_velocity);
  EXPECT_EQ(std::ranges::count(recording.velocity.begin() + 2150, recording.velocity.end(), 0.0), 500);
  EXPECT_TRUE(std::equal(before.begin(), before.begin() + 2040, recording.velocity.begin()));
}

}  // namespace
}  // namespace hysteron
