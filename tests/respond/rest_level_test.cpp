// Where free decays come to rest, and how small their last swings are.
#include "respond/rest_level.hpp"

#include <gtest/gtest.h>

#include "respond/decay.hpp"

namespace hysteron {
namespace {

using testing::Decay;

TEST(RestLevel, IsWhereADecayEnds) {
  const auto rest = rest_level_of(Decay{.from = 0.015, .zero = 0.005}.recording());
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->level, 0.005, 1e-6);
  EXPECT_NEAR(rest->largest, 0.015, 1e-4);
  // Down to its noise.
  EXPECT_LT(rest->last_swings, 1e-4);
}

TEST(RestLevel, IsNoneOfAMassThatStillMoves) { EXPECT_FALSE(rest_level_of(Decay{.samples = 500}.recording())); }

// A friction of k d holds the mass up to d off its equilibrium, and no swing before that is small.
TEST(RestLevel, TheLastSwingsOfAFrictionAreAsFarAsItsRestMayBe) {
  const double d = 0.001;
  const double omega = 20.0;
  Recording recording;
  double x = 0.0094;
  double centre = d;
  double begun = 0.0;
  for (std::size_t n = 0; n < 2000; ++n) {
    const double t = static_cast<double>(n) / 500.0;
    recording.time.push_back(t);
    const double half = 3.14159265358979 / omega;
    if (t - begun >= half && x != centre) {
      x = 2.0 * centre - x;
      begun += half;
      centre = std::fabs(x) <= d ? x : std::copysign(d, x);
    }
    recording.displacement.push_back(centre + (x - centre) * std::cos(omega * (t - begun)));
  }
  const auto rest = rest_level_of(recording);
  ASSERT_TRUE(rest);
  EXPECT_LT(std::fabs(rest->level), d);
  EXPECT_GT(rest->last_swings, d);
}

}  // namespace
}  // namespace hysteron
