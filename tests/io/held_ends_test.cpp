#include "io/held_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/reread.hpp"

namespace hysteron {
namespace {

using testing::said_of;

// A sine of 1 Hz at 200 Hz; a force with noise, in steps.
Recording recording(double noise_of_force, double step) {
  const Stream noise(3);
  Recording result;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const double phase = 0.01 * std::numbers::pi * static_cast<double>(n);
    result.time.push_back(0.005 * static_cast<double>(n));
    result.displacement.push_back(1e-5 * std::round(1e3 * std::sin(phase)));
    result.force.push_back(step * std::round((300.0 * std::cos(phase) + noise_of_force * noise.normal(n)) / step));
  }
  return result;
}

// The first or last `samples` hold what the one beside them has.
Recording filled(Recording result, std::size_t samples, bool first) {
  for (auto* values : {&result.displacement, &result.force}) {
    if (first) {
      std::fill_n(values->begin(), samples, (*values)[samples]);
    } else {
      std::fill_n(values->rbegin(), samples, (*values)[values->size() - 1 - samples]);
    }
  }
  return result;
}

TEST(HeldEnds, AreOfFilesThatWereFilledUp) {
  for (const bool first : {true, false}) {
    for (const std::size_t samples : {20U, 200U}) {
      const auto held = held_end_of(filled(recording(2.0, 0.01), samples, first));
      ASSERT_TRUE(held) << samples;
      EXPECT_EQ(held->first, first);
      EXPECT_EQ(held->count, samples + 1);
    }
  }
}

TEST(HeldEnds, AreNotOfARodThatRests) {
  EXPECT_FALSE(held_end_of(recording(2.0, 0.01)));
  EXPECT_FALSE(held_end_of(filled(recording(2.0, 0.01), 5, false)));
  // Without noise, or with less than a step of the converter, the force of a rod that rests holds too.
  EXPECT_FALSE(held_end_of(filled(recording(0.0, 1e-9), 200, false)));
  EXPECT_FALSE(held_end_of(filled(recording(0.0, 5.0), 200, false)));
  Recording resting = recording(2.0, 0.01);
  std::fill_n(resting.displacement.rbegin(), 200, 0.0);
  EXPECT_FALSE(held_end_of(resting));
}

TEST(HeldEnds, AreTold) {
  EXPECT_TRUE(said_of(recording(2.0, 0.01), "held end").empty());
  const auto said = said_of(filled(recording(2.0, 0.01), 200, false), "held end");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said.front(),
            "displacement and force have exactly one value each in the last 201 samples, from 3.995 s, and noise "
            "elsewhere: a file that was filled up with its last values looks so; cut them");
}

}  // namespace
}  // namespace hysteron
