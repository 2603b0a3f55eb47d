// What is left to the steady motion, from where the periods of a decaying one meet.
#include "respond/settling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

constexpr std::size_t samples = 100;
constexpr double omega = 2.0 * std::numbers::pi;

// A steady sine of 1 Hz, and an oscillation of `share` of it and this frequency (rad/s) that decays.
MassMotion settling(int periods, double share, double decay, double frequency) {
  MassMotion result;
  for (std::size_t n = 0; n <= samples * static_cast<std::size_t>(periods); ++n) {
    const double t = static_cast<double>(n) / static_cast<double>(samples);
    const double left = share * std::exp(-decay * t);
    result.displacement.push_back(std::sin(omega * t) + left * std::cos(frequency * t));
    result.velocity.push_back(omega * std::cos(omega * t) - left * frequency * std::sin(frequency * t) -
                              decay * left * std::cos(frequency * t));
  }
  return result;
}

TEST(Settling, TellsHowFarTheSteadyMotionIs) {
  // Slow and near the frequency of the excitation: small changes, and much is left.
  const Settling slow = settling_of(settling(50, 1.0, 0.03, 1.007 * omega), 50, samples);
  ASSERT_TRUE(slow.left);
  EXPECT_LT(slow.change, 0.02);
  EXPECT_NEAR(*slow.left, std::exp(-0.03 * 50.0), 0.08);
  EXPECT_NEAR(*slow.factor, std::exp(-0.03), 1e-3);
  // Of another frequency: no more is left than it changes by.
  const Settling other = settling_of(settling(20, 1.0, 0.03, 1.25 * omega), 20, samples);
  ASSERT_TRUE(other.left);
  EXPECT_NEAR(*other.left, std::exp(-0.03 * 20.0), 0.2);
}

TEST(Settling, OfASteadyMotionNothingIsLeft) {
  const Settling steady = settling_of(settling(3, 0.0, 0.03, omega), 3, samples);
  ASSERT_TRUE(steady.left);
  EXPECT_LT(*steady.left, 1e-9);
  const Settling one = settling_of(settling(1, 0.0, 0.03, omega), 1, samples);
  EXPECT_LT(one.change, 1e-9);
  const Settling growing = settling_of(settling(3, 0.1, -0.5, 1.3 * omega), 3, samples);
  EXPECT_FALSE(growing.left);
  EXPECT_GT(growing.change, 0.1);
}

}  // namespace
}  // namespace hysteron
