// Intervals of an effect's sizes, where what stays is noise and where physics is left out.
#include "diagnose/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr double mass = 12.0;

// Two motions, three recordings of each, of a viscous damper with a mass and a cubic stiffness `k3` in N/m^3.
std::vector<Recording> recordings_of(double k3) {
  LayoutOptions made;
  made.fix = {{"c0", 1500.0}, {"k0", 4000.0}, {"f0", 0.0}, {"inertia.m", mass}, {"cubic-stiffness.k3", k3}};
  const Layout layout(make_model("viscous", {"inertia", "cubic-stiffness"}), DataScale{}, made);
  std::vector<Recording> result;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const testing::Tone tone : {testing::Tone{0.02, 2.0}, testing::Tone{0.01, 5.0}}) {
      Recording recording = testing::motion("r" + std::to_string(result.size()) + ".csv", {tone}, 2.0, 800, 0.0);
      testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(3).child(result.size()));
      result.push_back(recording);
    }
  }
  return result;
}

ParameterInterval mass_of(const std::vector<Recording>& recordings) {
  const Workbench bench(scale_of(recordings), Split{recordings, {}, {}, false}, {}, {}, 1, [] { return false; });
  const Fit fit = bench.from_anywhere({"viscous", {"inertia"}, {}}, 2000);
  Estimates estimates(bench);
  return estimates.intervals(fit, "inertia").at(0);
}

bool holds(const ParameterInterval& row, double value) { return row.ci95->lower < value && value < row.ci95->upper; }

// A law that lacks the cubic stiffness takes part of it for a mass, the same in every recording: what differs between
// them does not show it, and what stays does.
TEST(Intervals, AllowForPhysicsThatIsLeftOut) {
  const ParameterInterval beside = mass_of(recordings_of(1e7));
  ASSERT_TRUE(beside.ci95.has_value());
  EXPECT_GT(std::fabs(beside.value - mass), 2.0 * *beside.half_width);
  EXPECT_TRUE(holds(beside, mass)) << beside.ci95->lower << " to " << beside.ci95->upper;
}

TEST(Intervals, AreNoWiderWhereNoiseIsLeft) {
  const ParameterInterval alone = mass_of(recordings_of(0.0));
  ASSERT_TRUE(alone.ci95.has_value());
  EXPECT_TRUE(holds(alone, mass)) << alone.ci95->lower << " to " << alone.ci95->upper;
  EXPECT_LT(alone.ci95->upper - alone.ci95->lower, 2.2 * *alone.half_width);
}

}  // namespace
}  // namespace hysteron
