#include "diagnose/residual/block_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hysteron {
namespace {

TEST(BlockScore, IsTheMeanOfLogRatiosOverRecordings) {
  // Halves of the squared residual in recordings 1 to 3, a quarter in the fourth.
  const BlockSquares a = {{4.0, 4.0}, {2.0}, {6.0}, {8.0}};
  const BlockSquares b = {{2.0, 2.0}, {1.0}, {3.0}, {2.0}};
  const BlockScore score = block_score(a, b, {0.0, 0.0, 0.0, 0.0}, {0, 1, 2, 3});
  const double unit = 0.5 * std::log(2.0);
  EXPECT_NEAR(score.mean, 1.25 * unit, 1e-12);
  EXPECT_NEAR(score.std_error, 0.25 * unit, 1e-12);  // values 1, 1, 1, 2 units: deviation 1/2, over sqrt(4)
  EXPECT_EQ(score.agreement, 1.0);
  EXPECT_EQ(score.clusters, 4U);
  EXPECT_NEAR(block_score(b, a, {0.0, 0.0, 0.0, 0.0}, {0, 1, 2, 3}).mean, -score.mean, 1e-12);
}

TEST(BlockScore, RecordingsOfOneMotionAreOneCluster) {
  // Four motions; the first, in which b is worse, was recorded five times.
  const BlockSquares a = {{1.0}, {1.0}, {1.0}, {1.0}, {1.0}, {4.0}, {4.0}, {4.0}};
  const BlockSquares b = {{4.0}, {4.0}, {4.0}, {4.0}, {4.0}, {1.0}, {1.0}, {1.0}};
  const BlockScore score = block_score(a, b, std::vector<double>(8, 0.0), {0, 0, 0, 0, 0, 1, 2, 3});
  EXPECT_EQ(score.clusters, 4U);
  EXPECT_NEAR(score.mean, 0.5 * std::log(2.0), 1e-12);
  EXPECT_EQ(score.agreement, 0.75);
  // Of three motions the recordings are the clusters.
  EXPECT_EQ(block_score(a, b, std::vector<double>(8, 0.0), {0, 0, 0, 0, 0, 1, 2, 2}).clusters, 8U);
}

TEST(BlockScore, DependsNeitherOnUnitsNorOnHowFinelyARecordingIsCut) {
  const BlockSquares a = {{4.0}, {2.0}, {6.0}, {8.0}, {1.0}};
  const BlockSquares b = {{2.0}, {1.9}, {3.0}, {2.0}, {1.1}};
  BlockSquares fine_a;
  BlockSquares fine_b;
  for (std::size_t r = 0; r < a.size(); ++r) {
    fine_a.emplace_back(7, 9.0 * a[r][0]);
    fine_b.emplace_back(7, 9.0 * b[r][0]);
  }
  const BlockScore coarse = block_score(a, b, std::vector<double>(5, 0.5), {0, 1, 2, 3, 4});
  const BlockScore fine = block_score(fine_a, fine_b, std::vector<double>(5, 4.5), {0, 1, 2, 3, 4});
  EXPECT_NEAR(fine.mean, coarse.mean, 1e-12);
  EXPECT_NEAR(fine.std_error, coarse.std_error, 1e-12);
}

TEST(BlockScore, BelowTheNoiseNeitherIsBetter) {
  const BlockSquares a(4, {1e-6});
  const BlockSquares b(4, {1e-9});
  EXPECT_LT(block_score(a, b, std::vector<double>(4, 1.0), {0, 1, 2, 3}).mean, 1e-5);
  EXPECT_GT(block_score(a, b, std::vector<double>(4, 0.0), {0, 1, 2, 3}).mean, 2.0);
}

TEST(BlockScore, OfFewRecordingsBlocksAreTheClusters) {
  const BlockScore score = block_score({{4.0, 2.0, 4.0}}, {{2.0, 2.0, 2.0}}, {0.0}, {0});
  EXPECT_EQ(score.clusters, 3U);
  EXPECT_NEAR(score.agreement, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(block_score({}, {}, {}, {}).z(), 0.0);
}

TEST(BlockScore, APredictionThatRanAwayIsTheWorstAndStaysFinite) {
  const double away = std::numeric_limits<double>::infinity();
  const BlockScore score =
      block_score({{away}, {away}, {1.0}, {1.0}}, {{1.0}, {1.0}, {1.0}, {1.0}}, {0, 0, 0, 0}, {0, 1, 2, 3});
  EXPECT_TRUE(std::isfinite(score.mean));
  EXPECT_GT(score.mean, 1.0);
  EXPECT_EQ(
      block_score({{away}, {away}, {away}, {away}}, {{away}, {away}, {away}, {away}}, {0, 0, 0, 0}, {0, 1, 2, 3}).mean,
      0.0);
}

TEST(BlockCount, IsThatOfTheCycles) {
  EXPECT_EQ(block_count(10.0, 1.0), 10U);
  EXPECT_EQ(block_count(1.0, 0.5), 4U);
  EXPECT_EQ(block_count(100.0, 5.0), 16U);
}

}  // namespace
}  // namespace hysteron
