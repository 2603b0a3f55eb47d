// A mass that is held before a free decay, and one that is not.
#include "respond/release.hpp"

#include <gtest/gtest.h>

#include "respond/decay.hpp"

namespace hysteron {
namespace {

using testing::Decay;

std::optional<std::size_t> release(const Decay& decay) {
  const Recording recording = decay.recording();
  return release_of(recording.time, recording.displacement);
}

TEST(Release, IsFoundWhereTheMassLeavesItsHold) {
  for (const std::size_t held : {15, 50, 500}) {
    for (const double noise : {0.0, 2e-6, 2e-5}) {
      const auto found = release(Decay{.held = held, .noise = noise});
      ASSERT_TRUE(found) << held << " " << noise;
      EXPECT_NEAR(static_cast<double>(*found), static_cast<double>(held), 4.0) << held << " " << noise;
    }
  }
}

TEST(Release, IsNoneWhereTheMassMovesFromTheFirstSampleOn) {
  for (const double noise : {0.0, 2e-6, 5e-5}) {
    EXPECT_FALSE(release(Decay{.noise = noise})) << noise;
    // Sampled so fast that it seems to stand at its crest for many samples.
    Recording slow = Decay{.noise = noise}.recording();
    slow.displacement.resize(200);
    slow.time.resize(200);
    EXPECT_FALSE(release_of(slow.time, slow.displacement)) << noise;
  }
}

TEST(Release, WhatIsLeftBeginsThere) {
  Recording recording = Decay{.held = 500}.recording();
  const Recording free = Decay{}.recording();
  begin_at(recording, 500);
  ASSERT_EQ(recording.size(), free.size());
  EXPECT_EQ(recording.time.front(), 1.0);
  for (std::size_t n = 0; n < free.size(); ++n) {
    ASSERT_NEAR(recording.velocity[n], free.velocity[n], 5e-3) << n;
  }
  EXPECT_EQ(recording.derived_acceleration.size(), free.size());
}

}  // namespace
}  // namespace hysteron
