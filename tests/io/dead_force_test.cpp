#include "io/dead_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "io/sines.hpp"

namespace hysteron {
namespace {

// Sines of 20, 30, 40 and 50 mm and of 300 N, noise of 2 N.
std::vector<Recording> campaign() {
  std::vector<Recording> result = testing::four_sines(1000, 0.01, 0.005);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Stream noise(k);
    for (std::uint64_t n = 0; n < result[k].size(); ++n) {
      result[k].force.push_back(300.0 * std::cos(0.01 * std::numbers::pi * static_cast<double>(n)) +
                                2.0 * noise.normal(n));
    }
  }
  return result;
}

void make_silent(Recording& recording, double noise_of_force) {
  const Stream noise(77);
  for (std::size_t n = 0; n < recording.size(); ++n) recording.force[n] = 3.0 + noise_of_force * noise.normal(n);
}

TEST(DeadForce, IsNoiseBesideForcesThatFollowTheMotion) {
  std::vector<Recording> recordings = campaign();
  EXPECT_TRUE(dead_forces_of(recordings).empty());
  make_silent(recordings[2], 2.0);
  const std::vector<DeadForce> dead = dead_forces_of(recordings);
  ASSERT_EQ(dead.size(), 1U);
  EXPECT_EQ(dead.front().recording, 2U);
  EXPECT_NEAR(dead.front().rms, 2.0, 0.1);
  EXPECT_NEAR(dead.front().expected, 0.8 * 212.0, 1.0);  // by the next faster one
  EXPECT_EQ(sentence_of(dead.front()).find("the force follows nothing of the motion and scatters by "), 0U);
}

TEST(DeadForce, IsNotThatOfAPlayOrOfAWeakSetting) {
  std::vector<Recording> recordings = campaign();
  make_silent(recordings[0], 2.0);  // of the shortest stroke
  EXPECT_TRUE(dead_forces_of(recordings).empty());

  recordings = campaign();
  for (double& force : recordings[2].force) force *= 0.02;
  EXPECT_TRUE(dead_forces_of(recordings).empty());

  recordings = campaign();
  make_silent(recordings[2], 200.0);  // of a size that another cause has
  EXPECT_TRUE(dead_forces_of(recordings).empty());
}

TEST(DeadForce, IsNotToldWhereMostAreAlike) {
  std::vector<Recording> recordings = campaign();
  make_silent(recordings[1], 2.0);
  make_silent(recordings[2], 2.0);
  EXPECT_TRUE(dead_forces_of(recordings).empty());
}

}  // namespace
}  // namespace hysteron
