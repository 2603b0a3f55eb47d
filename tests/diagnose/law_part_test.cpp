#include "diagnose/search/law_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnose/concealed_damper.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/workbenches.hpp"

namespace hysteron {
namespace {

using testing::campaign_of;
using testing::seed;

const SearchProgress silent = [](double, const std::string&) {};

// A damper of the modified Bouc-Wen law with a mass, of which Bouc-Wen misses the series dashpot and the mass.
Workbenches benches(double c1, double mass) {
  const Campaign campaign = campaign_of("modified-bouc-wen", {"inertia"},
                                        {{"alpha", 600.0},
                                         {"c0", 1500.0},
                                         {"c1", c1},
                                         {"k0", 2000.0},
                                         {"k1", 0.0},
                                         {"x_y", 8e-4},
                                         {"share", 0.6},
                                         {"n", 1.5},
                                         {"inertia.m", mass}},
                                        0.01);
  DiagnoseOptions options;
  options.model = "bouc-wen";
  options.seed = seed;
  std::vector<std::string> notes;
  return workbenches_of(campaign, split_of(campaign), options, notes);
}

TEST(LawPart, IsWhatTheLawGainsOverTheOneAskedForWithTheSameEffects) {
  const Workbenches bench = benches(3e4, 8.0);
  SearchOptions options;
  options.candidates = {"inertia", "series-dashpot", "compliance", "quadratic-damping"};
  options.most_effects = 0;
  const Search asked = search(bench.quick, bench.fine, {"bouc-wen", {}, {}}, options, silent);
  options.most_effects = 1;
  Search behind = search(bench.quick, bench.fine, {"modified-bouc-wen", {}, {}}, options, silent);
  ASSERT_EQ(behind.found.size(), 1U);
  take_parts_of_law(behind, asked, bench.quick, options, silent);
  ASSERT_EQ(behind.found.size(), 2U);
  const Found& part = behind.found.back();
  EXPECT_EQ(part.part.effect, "series-dashpot");
  EXPECT_EQ(part.of_law, "modified-bouc-wen");
  EXPECT_EQ(part.without.what, (Hypothesis{"bouc-wen", {"inertia"}, {}}));
  EXPECT_NEAR(part.gain, squared(part.without.cost) - squared(behind.quick_augmented.cost), 1e-15);
  EXPECT_GT(part.gain, 10.0 * squared(behind.quick_augmented.cost)) << "the dashpot is most of what Bouc-Wen misses";
  EXPECT_NEAR(part.alone, squared(asked.quick_base.cost) - squared(behind.quick_base.cost), 1e-15);
  EXPECT_TRUE(std::ranges::any_of(part.rivals, [](const Rival& rival) {
    return rival.part.effect == "compliance" && rival.fit;
  })) << "its relative is refitted in its place";
  EXPECT_TRUE(std::ranges::none_of(part.rivals, [](const Rival& rival) { return rival.part.effect == "inertia"; }));
}

// As an effect behind Bouc-Wen the part is the same physics.
TEST(LawPart, IsWorthAsMuchBehindALawThatLacksIt) {
  const Workbenches bench = benches(2e5, 40.0);
  SearchOptions options;
  options.candidates = {"inertia", "series-dashpot"};
  options.laws = {"bouc-wen"};
  options.most_effects = 0;
  const Search asked = search(bench.quick, bench.fine, {"bouc-wen", {}, {}}, options, silent);
  options.most_effects = 1;
  Search behind = search(bench.quick, bench.fine, {"modified-bouc-wen", {}, {}}, options, silent);
  take_parts_of_law(behind, asked, bench.quick, options, silent);
  ASSERT_EQ(behind.found.size(), 2U);
  try_behind_other_laws(behind, bench.quick);
  ASSERT_EQ(behind.swaps.size(), 1U);
  ASSERT_EQ(behind.swaps[0].without.size(), 2U);
  EXPECT_NEAR(behind.swaps[0].without[1] - behind.swaps[0].squares, behind.found[1].gain, 0.2 * behind.found[1].gain);
}

// What is missing does not depend on which law that lacks it was told.
TEST(LawPart, IsWorthTheSameWhicheverLawThatLacksItWasAskedFor) {
  const Workbenches bench = benches(3e4, 8.0);
  SearchOptions options;
  options.candidates = {"inertia", "series-dashpot"};
  const auto part_behind = [&](const std::string& law) {
    options.most_effects = 0;
    options.laws = {"bouc-wen", "modified-bouc-wen"};
    std::erase(options.laws, law);
    const Search asked = search(bench.quick, bench.fine, {law, {}, {}}, options, silent);
    options.most_effects = 1;
    Search behind = search(bench.quick, bench.fine, {"modified-bouc-wen", {}, {}}, options, silent);
    take_parts_of_law(behind, asked, bench.quick, options, silent);
    return behind.found;
  };
  const std::vector<Found> less = part_behind("bingham");
  const std::vector<Found> same = part_behind("bouc-wen");
  ASSERT_EQ(less.size(), 2U);
  ASSERT_EQ(same.size(), 2U);
  EXPECT_EQ(less[1].part.effect, "series-dashpot");
  EXPECT_EQ(less[1].without.what, (Hypothesis{"bouc-wen", {"inertia"}, {}}));
  EXPECT_NEAR(less[1].gain, same[1].gain, 0.05 * same[1].gain);
  EXPECT_NEAR(less[1].alone, same[1].alone, 0.05 * same[1].alone);
}

TEST(LawPart, IsNoneOfALawThatTheOneAskedForHasToo) {
  const Workbenches bench = benches(3e4, 8.0);
  SearchOptions options;
  options.candidates = {"series-dashpot"};
  options.most_effects = 0;
  const Search asked = search(bench.quick, bench.fine, {"modified-bouc-wen", {}, {}}, options, silent);
  Search behind = asked;
  take_parts_of_law(behind, asked, bench.quick, options, silent);
  EXPECT_TRUE(behind.found.empty());
}

}  // namespace
}  // namespace hysteron
