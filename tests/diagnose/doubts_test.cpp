// Faults of channels on which no name is given.
#include "diagnose/doubts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "core/random.hpp"
#include "io/sines.hpp"

namespace hysteron {
namespace {

// Sines of 10 to 40 mm, of 1200 N s/m, under a load cell that ends at `most` N; noise of 1 N.
std::vector<Recording> campaign(double most = std::numeric_limits<double>::infinity()) {
  std::vector<Recording> result = testing::four_sines(2000, 0.01, 0.01);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Stream noise(k);
    for (std::uint64_t n = 0; n < result[k].size(); ++n) {
      result[k].force.push_back(std::clamp(1200.0 * result[k].velocity[n], -most, most) + noise.normal(n));
    }
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
