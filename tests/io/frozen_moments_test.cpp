#include "io/frozen_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/reread.hpp"

namespace hysteron {
namespace {

using testing::said_of;

// A sine of 1 Hz and 10 mm at 200 Hz, four periods, in steps of a quantum; the force of a damper.
Recording recording(double quantum = 1e-6) {
  Recording result;
  for (std::size_t n = 0; n < 800; ++n) {
    const double phase = 0.01 * std::numbers::pi * static_cast<double>(n);
    result.time.push_back(0.005 * static_cast<double>(n));
    result.displacement.push_back(quantum * std::round(0.01 * std::sin(phase) / quantum));
    result.force.push_back(300.0 * std::cos(phase) + 100.0 * std::tanh(5.0 * std::cos(phase)));
  }
  return result;
}

// From `first` on so many more samples have its value.
std::vector<double> held(std::vector<double> values, std::size_t first, std::size_t more) {
  std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(first), more + 1, values[first]);
  return values;
}

Recording frozen(std::size_t first, std::size_t more) {
  Recording result = recording();
  result.displacement = held(result.displacement, first, more);
  return result;
}

TEST(FrozenMoments, EndWhereTheMotionWentMeanwhile) {
  // At the peaks of the force, and 0.1 s before and behind them.
  for (const std::size_t first : {180U, 195U, 210U, 298U}) {
    for (const std::size_t more : {4U, 6U, 10U}) {
      const auto moments = frozen_moments_of(frozen(first, more));
      ASSERT_TRUE(moments) << first << " " << more;
      EXPECT_EQ(moments->first, first);
      EXPECT_EQ(moments->last, first + more);
      EXPECT_EQ(moments->count, 1U);
      EXPECT_FALSE(moments->force_holds);
    }
  }
  Recording twice = frozen(195, 6);
  twice.displacement = held(twice.displacement, 410, 4);
  EXPECT_EQ(frozen_moments_of(twice)->count, 2U);
  EXPECT_EQ(frozen_moments_of(twice)->first, 195U);
}

TEST(FrozenMoments, AreNotOfARodThatRests) {
  for (const double quantum : {1e-6, 1e-4, 1e-3, 5e-3}) EXPECT_FALSE(frozen_moments_of(recording(quantum))) << quantum;
  // A dwell at the ends, a pause in mid-stroke, and steps to levels that are held.
  Recording dwells = recording();
  for (double& x : dwells.displacement) x = std::clamp(x, -0.009, 0.009);
  EXPECT_FALSE(frozen_moments_of(dwells));
  Recording pauses = recording();
  for (std::size_t n = 200; n < 800; ++n) pauses.displacement[n] = recording().displacement[n < 230 ? 200 : n - 30];
  EXPECT_FALSE(frozen_moments_of(pauses));
  Recording levels = recording();
  for (std::size_t n = 0; n < 800; ++n) levels.displacement[n] = 0.001 * static_cast<double>(n / 20 % 7);
  EXPECT_FALSE(frozen_moments_of(levels));
  // Slower than its quantum.
  Recording slow = recording();
  for (std::size_t n = 0; n < 800; ++n) slow.displacement[n] = 1e-5 * std::round(0.17 * static_cast<double>(n));
  EXPECT_FALSE(frozen_moments_of(slow));
  // A pause behind which the rod is quicker than before.
  Recording quicker = recording();
  for (std::size_t n = 0; n < 800; ++n) {
    const double t = static_cast<double>(n);
    quicker.displacement[n] = n < 300 ? 1e-5 * t : n < 340 ? 3e-3 : 3e-3 + 1e-4 * (t - 340.0);
  }
  EXPECT_FALSE(frozen_moments_of(quicker));
}

// A leap that does not go where the motion would have gone is another fault.
TEST(FrozenMoments, AreNotOfRecordsThatWereJoined) {
  for (const double off : {0.01, -0.01}) {
    Recording joined = frozen(195, 6);
    for (std::size_t n = 202; n < 800; ++n) joined.displacement[n] += off;
    EXPECT_FALSE(frozen_moments_of(joined));
  }
}

TEST(FrozenMoments, AreToldOnce) {
  EXPECT_TRUE(said_of(recording(), "frozen moments").empty());
  const auto said = said_of(frozen(195, 10), "frozen moments");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(
      said.front(),
      "the displacement stays at exactly -1.564 mm from 0.975 to 1.025 s and is 3.44 mm further at the next "
      "sample, as far as its speed before and behind would have taken it, 1 time like that: a channel that froze "
      "for a moment looks so; its slope is 0 there and far too high behind, which shifts damping and stiffness; cut "
      "these samples");
  EXPECT_TRUE(said_of(frozen(195, 10), "leap").empty());
  EXPECT_TRUE(said_of(frozen(195, 10), "frozen displacement").empty());
}

TEST(FrozenMoments, OfBothChannelsAreRowsThatWereRepeated) {
  Recording repeated = frozen(210, 5);
  repeated.force = held(repeated.force, 210, 5);
  EXPECT_TRUE(frozen_moments_of(repeated)->force_holds);
  const auto said = said_of(repeated, "frozen moments");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(said.front().starts_with("the displacement stays, and the force with it, at exactly 3.09 mm"));
  EXPECT_NE(said.front().find("a logger that repeats a row while it waits looks so"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
