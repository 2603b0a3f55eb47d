// Faults of channels on which no name is given.
#include "diagnose/doubts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/random.hpp"

namespace hysteron {
namespace {

// Sines of 10 to 40 mm, of 1200 N s/m, under a load cell that ends at `most` N; noise of 1 N.
std::vector<Recording> campaign(double most = std::numeric_limits<double>::infinity()) {
  std::vector<Recording> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const Stream noise(k);
    Recording one;
    one.file = "r" + std::to_string(k + 1) + ".csv";
    const double amplitude = 0.01 + 0.01 * static_cast<double>(k);
    for (std::uint64_t n = 0; n < 2000; ++n) {
      const double phase = 0.01 * std::numbers::pi * static_cast<double>(n);
      one.time.push_back(0.005 * static_cast<double>(n));
      one.displacement.push_back(amplitude * std::sin(phase));
      one.velocity.push_back(2.0 * std::numbers::pi * amplitude * std::cos(phase));
      one.force.push_back(std::clamp(1200.0 * one.velocity.back(), -most, most) + noise.normal(n));
    }
    result.push_back(one);
  }
  return result;
}

TEST(DoubtOfChannels, OfALoadCellThatSaturatesOrIsDead) {
  EXPECT_EQ(doubt_of_channels(campaign()), "");
  EXPECT_EQ(doubt_of_channels(campaign(180.0)).find("the force rests at 180 and -180 N"), 0U);
  std::vector<Recording> dead = campaign();
  const Stream noise(9);
  for (std::size_t n = 0; n < dead[2].size(); ++n) dead[2].force[n] = noise.normal(n);
  EXPECT_EQ(doubt_of_channels(dead).find("r3.csv: the force follows nothing of the motion"), 0U);
}

// Nothing but noise is left only where that was found.
TEST(Surprises, AreToldByWhatTheFittedRecordingsHaveLeft) {
  const std::vector<std::string> files = {"r7.csv"};
  EXPECT_EQ(sentence_of_surprises(files, false).find("nothing but noise is left on the fitted recordings"), 0U);
  const std::string text = sentence_of_surprises(files, true);
  EXPECT_EQ(text.find("nothing but noise"), std::string::npos) << text;
  EXPECT_EQ(text.find("over its noise more than 2 times as much is left of r7.csv"), 0U) << text;
}

}  // namespace
}  // namespace hysteron
