#include "diagnose/search/settle.hpp"

#include <gtest/gtest.h>

#include "diagnose/concealed_damper.hpp"
#include "diagnose/workbenches.hpp"

namespace hysteron {
namespace {

// An entrapped gas behind a steep hysteresis is found as a compliance, its limit here. The law's own yield displacement
// makes up for most of either, and the way from there to what the gas is takes many rounds.
TEST(Settled, RivalsAreFittedAsFarAsWhatTheyStandAgainst) {
  const Campaign campaign = testing::campaign_of("bouc-wen", {"entrapped-gas"},
                                                 {{"alpha", 600.0},
                                                  {"c0", 1500.0},
                                                  {"k0", 2000.0},
                                                  {"f0", 20.0},
                                                  {"x_y", 4e-4},
                                                  {"share", 0.5},
                                                  {"n", 2.0},
                                                  {"entrapped-gas.d_a", 1e-4},
                                                  {"entrapped-gas.f_a", 500.0},
                                                  {"entrapped-gas.e_a", 0.0},
                                                  {"entrapped-gas.C_c", 9e-7}},
                                                 0.01);
  DiagnoseOptions asked;
  asked.model = "bouc-wen";
  asked.seed = testing::seed;
  std::vector<std::string> notes;
  const Workbenches bench = workbenches_of(campaign, split_of(campaign), asked, notes);
  SearchOptions options;
  options.candidates = {"entrapped-gas", "compliance", "clearance", "sensor-delay"};
  options.laws = {};
  options.most_effects = 1;
  const Search found =
      search(bench.quick, bench.fine, {"bouc-wen", {}, {}}, options, [](double, const std::string&) {});
  ASSERT_EQ(found.found.size(), 1U);
  const Found& one = found.found.front();
  int refitted = 0;
  for (const Rival& rival : one.rivals) {
    if (rival.fit) {
      ++refitted;
      const Fit further = bench.quick.polished(*rival.fit, 20);
      EXPECT_LT(squared(rival.fit->cost) - squared(further.cost), 0.02 * one.gain) << rival.part.effect;
    }
  }
  EXPECT_GT(refitted, 0);
}

}  // namespace
}  // namespace hysteron
