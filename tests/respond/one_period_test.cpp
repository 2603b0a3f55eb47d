#include "respond/one_period.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

// `count` samples of a sine with 200 samples a period, from `phase` samples on.
std::vector<double> sine(std::size_t count, double phase) {
  std::vector<double> result;
  for (std::size_t n = 0; n < count; ++n) {
    result.push_back(std::sin(2.0 * std::numbers::pi * (static_cast<double>(n) + phase) / 200.0));
  }
  return result;
}

TEST(OnePeriod, TellsWhetherTheLastSampleRepeatsTheFirst) {
  // From the middle, from an end of the stroke, from in between and symmetrically about an end.
  for (const double phase : {0.0, 50.0, 20.0, 50.5, 137.25}) {
    EXPECT_TRUE(last_repeats_first(sine(201, phase))) << phase;
    EXPECT_FALSE(last_repeats_first(sine(200, phase))) << phase;
  }
  EXPECT_FALSE(last_repeats_first({}));
  EXPECT_FALSE(last_repeats_first(std::vector<double>(50, 1.0))) << "a constant tells nothing";
}

TEST(OnePeriod, RepeatsItsTimes) {
  const std::vector<double> time = {0.0, 0.1, 0.2, 0.3};
  const std::vector<double> three = repeated_times(time, 3);
  ASSERT_EQ(three.size(), 12U);
  for (std::size_t n = 0; n < three.size(); ++n) {
    EXPECT_NEAR(three[n], 0.1 * static_cast<double>(n), 1e-12);
  }
}

}  // namespace
}  // namespace hysteron
