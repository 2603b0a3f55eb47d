#include "diagnose/acting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "diagnose/intervals.hpp"
#include "fit/score.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t seed = 5;
constexpr double upper_stop = 0.009;

// Two sines of a viscous damper that pass its upper stop, and one that does not reach it; no lower stop.
std::vector<Recording> of_a_stop() {
  LayoutOptions made;
  made.fix = {
      {"c0", 1500.0},          {"k0", 0.0},        {"f0", 0.0}, {"end-stop.k_b", 2e5}, {"end-stop.x_up", upper_stop},
      {"end-stop.x_low", 1.0}, {"end-stop.p", 1.0}};
  const Layout layout(make_model("viscous", {"end-stop"}), DataScale{}, made);
  std::vector<Recording> result;
  for (const double amplitude : {0.012, 0.006, 0.011}) {
    Recording recording =
        testing::motion("r" + std::to_string(result.size()) + ".csv", {{amplitude, 1.0}}, 3.0, 400, 0.0);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(seed).child(result.size()));
    result.push_back(recording);
  }
  return result;
}

class Acting : public ::testing::Test {
 protected:
  std::vector<Recording> recordings_ = of_a_stop();
  ObjectiveOptions options_;
  Workbench bench_{scale_of(recordings_), Split{recordings_, {}, {}, false}, {}, options_, seed, [] { return false; }};

  // Descended from stops just inside the motion, at either end of it.
  Fit fitted() {
    const Hypothesis what{"viscous", {"end-stop"}, {}};
    const auto layout = std::make_shared<const Layout>(bench_.layout(what));
    const std::vector<double> point = testing::point_with(
        *layout, layout->initial(), {{"end-stop.k_b", 1e5}, {"end-stop.x_up", 0.0095}, {"end-stop.x_low", 0.01195}});
    return bench_.from_starts(what, {layout, {point}, point, {}}, 20, 1);
  }
};

TEST_F(Acting, AStopDoesNothingWhereTheMotionDoesNotReachIt) {
  const Fit fit = fitted();
  EXPECT_EQ(acting_in(bench_, fit, "end-stop"), (std::vector<bool>{true, false, true}));
  Contrast contrast;
  contrast.value = 2e5;
  contrast.of_recordings = {{0, 1.9e5}, {1, 3e5}, {2, -1e4}};
  const Seen seen = seen_in(contrast, acting_in(bench_, fit, "end-stop"));
  EXPECT_EQ(seen.seen, 1U) << "the second is not reached, the third has the other sign";
  EXPECT_EQ(seen.of, 3U);
}

TEST_F(Acting, APartOfTheLawActsEverywhere) {
  EXPECT_EQ(acting_in(bench_, fitted(), "linear-stiffness"), std::vector<bool>(3, true));
}

TEST_F(Acting, AStopAtTheEndOfTheMotionHasNoInterval) {
  Estimates estimates(bench_);
  for (const ParameterInterval& row : estimates.intervals(fitted(), "end-stop")) {
    if (row.name == "x_up") {
      ASSERT_TRUE(row.ci95.has_value());
      EXPECT_NEAR(row.value, upper_stop, 2e-4);
    }
    if (row.name == "x_low") {
      EXPECT_FALSE(row.ci95.has_value()) << row.value;
    }
  }
}

}  // namespace
}  // namespace hysteron
