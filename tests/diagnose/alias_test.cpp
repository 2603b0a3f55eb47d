// What looks alike by theory looks alike in the map, and what the base model has of its own is not in it.
#include "diagnose/search/alias.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// Beside a spring and a dashpot on sines of these frequencies in Hz, softly started from rest within `ramp` seconds.
AliasMap map_of(const std::vector<double>& frequencies, double ramp, const std::vector<std::string>& effects) {
  std::vector<Recording> recordings;
  for (const double frequency : frequencies) {
    Recording recording = testing::motion("r.csv", {{0.01, frequency}}, 5.0, 2000, ramp);
    recording.velocity_measured = true;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.force.push_back(5e4 * recording.displacement[n] + 8e3 * recording.velocity[n]);
    }
    recording.derived_acceleration.assign(recording.size(), 0.0);
    for (std::size_t n = 1; n + 1 < recording.size(); ++n) {
      recording.derived_acceleration[n] =
          (recording.velocity[n + 1] - recording.velocity[n - 1]) / (recording.time[n + 1] - recording.time[n - 1]);
    }
    recordings.push_back(std::move(recording));
  }
  Split split;
  split.fit = recordings;
  split.judge = {{recordings.front(), 0}};
  const Workbench bench(scale_of(recordings), split, {}, {}, 1, [] { return false; });
  return alias_map(bench, bench.from_anywhere({"viscous", {}, {}}, 2000), effects);
}

double cosine(const AliasMap& map, const std::string& a, const std::string& b) {
  const auto i = std::ranges::find(map.effects, a) - map.effects.begin();
  const auto j = std::ranges::find(map.effects, b) - map.effects.begin();
  return map.cosine.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
}

TEST(Alias, ADelayedDashpotLooksLikeAMass) {
  // To first order the delay takes tau c a off the force; what it takes of the spring is a dashpot, which the model
  // has.
  const AliasMap map = map_of({0.7, 1.3, 2.1}, 0.3, {"inertia", "sensor-delay", "force-drift"});
  ASSERT_EQ(map.effects, (std::vector<std::string>{"inertia", "sensor-delay", "force-drift"}));
  EXPECT_GT(cosine(map, "inertia", "sensor-delay"), 0.98);
  EXPECT_LT(cosine(map, "inertia", "force-drift"), 0.1);
  const std::vector<AlikePair> pairs = alike_pairs(map);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].effect, "inertia");
  EXPECT_EQ(pairs[0].other, "sensor-delay");
}

TEST(Alias, WhatTheModelImitatesHasNoRow) {
  // At one frequency, in motion from the first sample on, a mass is a negative spring.
  const AliasMap map = map_of({1.3}, 0.0, {"inertia", "linear-stiffness", "viscous-damping", "cubic-stiffness"});
  EXPECT_EQ(map.effects, (std::vector<std::string>{"cubic-stiffness"}));
}

TEST(Alias, AFormLooksLikeItsLimitAndAForceOfPlaceNotLikeOneOfSpeed) {
  const AliasMap map = map_of({0.7, 1.3, 2.1}, 0.3, {"coulomb-friction", "seal-friction", "cubic-stiffness"});
  ASSERT_EQ(map.effects.size(), 3U);
  EXPECT_GT(cosine(map, "coulomb-friction", "seal-friction"), 0.999);
  EXPECT_LT(cosine(map, "coulomb-friction", "cubic-stiffness"), 0.1);
  EXPECT_EQ(cosine(map, "seal-friction", "coulomb-friction"), cosine(map, "coulomb-friction", "seal-friction"));
}

}  // namespace
}  // namespace hysteron
