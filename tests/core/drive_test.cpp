#include "core/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random.hpp"

namespace hysteron {
namespace {

std::vector<double> noise(std::size_t count, double sigma) {
  const Stream stream(11);
  std::vector<double> result(count);
  for (std::size_t n = 0; n < count; ++n) {
    result[n] = sigma * stream.normal(n);
  }
  return result;
}

double deviation(const std::vector<double>& a, const std::vector<double>& b, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t n = from; n < to; ++n) {
    sum += (a[n] - b[n]) * (a[n] - b[n]);
  }
  return std::sqrt(sum / static_cast<double>(to - from));
}

TEST(Drive, NoiseAloneIsNoVariation) {
  for (const double level : {0.0, 0.5, 2.0}) {
    std::vector<double> drive = noise(20000, 0.01);
    for (double& value : drive) {
      value += level;
    }
    EXPECT_NEAR(drive_noise(drive), 0.01, 3e-4);
    EXPECT_FALSE(varies(drive)) << level;
    const std::vector<double> quiet = quiet_drive(drive);
    EXPECT_EQ(std::ranges::max(quiet), std::ranges::min(quiet));
    EXPECT_NEAR(quiet.front(), level, 3e-4);
  }
  EXPECT_FALSE(varies({}));
  EXPECT_FALSE(varies(std::vector<double>(100, 1.5)));
}

TEST(Drive, StepsStayAndLoseTheirNoise) {
  const std::size_t count = 6000;
  std::vector<double> clean(count);
  for (std::size_t n = 0; n < count; ++n) {
    clean[n] = n / 500 % 2 == 0 ? 0.0 : 1.0;
  }
  EXPECT_EQ(drive_noise(clean), 0.0);
  EXPECT_TRUE(varies(clean));
  EXPECT_EQ(quiet_drive(clean), clean);
  std::vector<double> noisy = noise(count, 0.005);
  std::ranges::transform(noisy, clean, noisy.begin(), std::plus{});
  ASSERT_TRUE(varies(noisy));
  const std::vector<double> quiet = quiet_drive(noisy);
  // A parabola through 17 samples leaves sqrt(3 (3 8^2 + 3 8 - 1) / (15 17 19)) of the noise, 0.365, in its middle.
  EXPECT_NEAR(deviation(quiet, clean, 520, 980), 0.365 * 0.005, 0.03 * 0.005);
  EXPECT_LT(std::fabs(quiet[499]), 0.02);
  EXPECT_GT(quiet[500], 0.98);
}

TEST(Drive, WhatVariesSmoothlyIsNotDelayedOrFlattened) {
  const std::size_t count = 4000;
  std::vector<double> clean(count);
  for (std::size_t n = 0; n < count; ++n) {
    clean[n] = 1.0 + std::sin(2.0 * std::numbers::pi * static_cast<double>(n) / 200.0);
  }
  std::vector<double> noisy = noise(count, 0.01);
  std::ranges::transform(noisy, clean, noisy.begin(), std::plus{});
  const std::vector<double> quiet = quiet_drive(noisy);
  EXPECT_LT(deviation(quiet, clean, 0, count), 0.8 * deviation(noisy, clean, 0, count));
  const double product = std::inner_product(quiet.begin(), quiet.end(), clean.begin(), 0.0);
  const double squares = std::inner_product(clean.begin(), clean.end(), clean.begin(), 0.0);
  EXPECT_NEAR(product / squares, 1.0, 2e-3);
}

// A sine with sixty samples a period and noise of 4 % of its amplitude: what it is flattened by is what a force that
// follows the drive is overestimated by.
TEST(Drive, NoiseDoesNotFlattenWhatIsCurved) {
  const std::size_t count = 6000;
  std::vector<double> clean(count);
  for (std::size_t n = 0; n < count; ++n) {
    clean[n] = 0.5 * std::sin(2.0 * std::numbers::pi * static_cast<double>(n) / 60.0);
  }
  std::vector<double> noisy = noise(count, 0.02);
  std::ranges::transform(noisy, clean, noisy.begin(), std::plus{});
  const std::vector<double> quiet = quiet_drive(noisy);
  const double product = std::inner_product(quiet.begin(), quiet.end(), clean.begin(), 0.0);
  const double squares = std::inner_product(clean.begin(), clean.end(), clean.begin(), 0.0);
  EXPECT_NEAR(product / squares, 1.0, 3e-3);
}

TEST(Levels, AreWhatDiffersByMoreThanASettingDoes) {
  EXPECT_EQ(count_levels({}), 0U);
  EXPECT_EQ(count_levels({0.0, 0.0}), 1U);
  EXPECT_EQ(count_levels({1.0, 1.002, 1.004, 1.001}), 1U);
  EXPECT_EQ(count_levels({0.5, 0.0, 1.0, 0.5}), 3U);
  // In any unit, and of either sign.
  EXPECT_EQ(count_levels({0.5e-3, 0.0, 1.0e-3, 0.5e-3}), 3U);
  EXPECT_EQ(count_levels({-2000.0, 0.0, 2000.0}), 3U);
}

}  // namespace
}  // namespace hysteron
