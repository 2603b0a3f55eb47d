#include "check/channels_beside_others.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "check/campaign.hpp"
#include "core/random.hpp"
#include "io/sines.hpp"

namespace hysteron {
namespace {

// Sines of 10 to 40 mm, of 1200 N s/m under a load cell that ends at 180 N, with noise of `before` N under the end and
// of `behind` N on it.
std::vector<Recording> clipped(double before, double behind) {
  std::vector<Recording> result = testing::four_sines(2000, 0.01, 0.01);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Stream noise(k);
    for (std::uint64_t n = 0; n < result[k].size(); ++n) {
      const double force = 1200.0 * result[k].velocity[n] + before * noise.normal(n);
      result[k].force.push_back(std::clamp(force, -180.0, 180.0) + behind * noise.normal(9000 + n));
    }
  }
  return result;
}

std::vector<std::string> keys_of(const std::vector<Remark>& remarks) {
  std::vector<std::string> keys;
  for (const Remark& remark : remarks) keys.push_back(remark.file + " " + remark.key);
  return keys;
}
using Keys = std::vector<std::string>;

TEST(ChannelsBesideOthers, ALoadCellThatSaturatesUnderNoise) {
  const std::vector<Remark> said = remarks_on_channels_beside_others(clipped(1.0, 0.3));
  ASSERT_EQ(keys_of(said), Keys{"r3.csv clipped force"});
  EXPECT_EQ(
      said.front().text.plain(),
      "the force rests at 180 and -180 N, the ends of its range, in 2 of 4 recordings, for up to 30 % of the "
      "samples, whatever the motion and the drive: a channel that saturates looks so; record with a wider range, or "
      "leave these recordings out");
  // What a recording shows alone is told of it.
  EXPECT_TRUE(remarks_on_channels_beside_others(clipped(1.0, 0.0)).empty());
  const auto all = keys_of(remarks_on(clipped(1.0, 0.3), Moving::damper));
  EXPECT_EQ(std::ranges::count(all, "r3.csv clipped force"), 1);
}

TEST(ChannelsBesideOthers, ADeadLoadCell) {
  std::vector<Recording> recordings = clipped(1.0, 0.3);
  recordings.pop_back();
  recordings.push_back(recordings.front());
  const Stream noise(9);
  for (std::size_t n = 0; n < recordings[1].size(); ++n) recordings[1].force[n] = noise.normal(n);
  EXPECT_EQ(keys_of(remarks_on_channels_beside_others(recordings)), Keys{"r2.csv dead force"});
}

}  // namespace
}  // namespace hysteron
