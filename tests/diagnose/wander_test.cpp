// A factor of the force that changes with time is told from noise of any colour, and from what a delay leaves.
#include "diagnose/residual/wander.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Three sines of 8 s, their forces those of a yielding damper; the residual at a time with the force there, plus
// coloured noise of the given size.
std::vector<Leftover> leftovers(const std::function<double(double time, double force, double slope)>& residual,
                                double noise) {
  std::vector<Leftover> result;
  const Stream stream = Stream(5).child("noise");
  std::uint64_t drawn = 0;
  for (const double frequency : {0.7, 1.6, 3.1}) {
    Leftover one;
    double coloured = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double t = 0.002 * n;
      const double v = std::sin(two_pi * frequency * t);
      const double level = std::tanh(8.0 * v);
      const double slope = 8.0 * (1.0 - level * level) * std::cos(two_pi * frequency * t);
      const double force = level + 0.3 * v;
      coloured = 0.95 * coloured + stream.normal(drawn++);
      one.time.push_back(t);
      one.force.push_back(1000.0 * force);
      one.residual.push_back(residual(t, force, slope) + noise * coloured * std::sqrt(1.0 - 0.95 * 0.95));
    }
    result.push_back(std::move(one));
  }
  return result;
}

TEST(Wander, SupplyThatCyclesIsSeenWithItsPeriod) {
  for (const double period : {0.7, 1.3, 2.5}) {
    const Wandering found = wandering(
        leftovers([&](double t, double f, double) { return 0.03 * f * std::sin(two_pi * t / period + 1.0); }, 0.01));
    EXPECT_TRUE(wanders(found)) << period;
    EXPECT_NEAR(found.period, period, 0.05 * period);
    EXPECT_GT(found.share, 0.6);
  }
}

TEST(Wander, GripThatChangesIsSeen) {
  const Wandering found = wandering(leftovers(
      [](double t, double f, double) { return t < 3.0 ? 0.05 * f : (t < 5.0 ? -0.04 * f : 0.01 * f); }, 0.01));
  EXPECT_TRUE(wanders(found));
}

TEST(Wander, NoiseOfAnyColourIsNone) {
  EXPECT_FALSE(wanders(wandering(leftovers([](double, double, double) { return 0.0; }, 0.02))));
}

TEST(Wander, WhatADelayLeavesIsNone) {
  EXPECT_FALSE(wanders(wandering(leftovers([](double, double, double slope) { return 0.02 * slope; }, 0.01))));
}

TEST(Wander, RecordingsOfAnotherSizeAreNone) {
  int calls = 0;
  EXPECT_FALSE(wanders(wandering(leftovers(
      [&](double, double f, double) {
        const int recording = calls++ / 4000;
        return (recording == 0 ? 0.02 : (recording == 1 ? -0.02 : 0.01)) * f;
      },
      0.01))));
}

TEST(Wander, TooFewSamplesAreNone) { EXPECT_FALSE(wanders(wandering({Leftover{{0.0}, {1.0}, {1.0}}}))); }

}  // namespace
}  // namespace hysteron
