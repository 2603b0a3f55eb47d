// What recordings one by one would have a parameter be, of dampers whose law lacks what depends on the amplitude.
#include "diagnose/residual/drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/search/of_fit.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// Eight sines of a dashpot, amplitude and frequency changed independently of each other, fitted by a dashpot alone.
Drift drift_with(const std::vector<std::string>& effects, const std::map<std::string, double>& values) {
  LayoutOptions made;
  made.fix = {{"c0", 2000.0}};
  made.fix.insert(values.begin(), values.end());
  const Layout layout(make_model("viscous", effects), DataScale{}, made);
  Campaign campaign;
  const std::array<double, 8> frequencies = {3.0, 1.0, 2.4, 0.7, 1.9, 0.9, 2.8, 1.4};
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const double speed = 0.02 + 0.03 * static_cast<double>(k);
    Recording recording = testing::motion("r" + std::to_string(k) + ".csv", {{speed / frequencies[k], frequencies[k]}},
                                          3.0 / frequencies[k], 400, 0.2 / frequencies[k]);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(3).child(k));
    campaign.recordings.push_back(recording);
    campaign.roles.push_back(k == 4 ? Role::validate : Role::fit);
  }
  const Workbench bench(scale_of(campaign.recordings), split_of(campaign), {}, {}, 1, [] { return false; });
  return drift_of(bench, bench.from_anywhere({"viscous", {}, {}}, 2000));
}

TEST(Drift, OfTheRightLawIsNoise) {
  const Drift drift = drift_with({}, {});
  ASSERT_EQ(drift.recordings.size(), 7U);
  ASSERT_FALSE(drift.parameters.empty());
  for (const DriftOfParameter& parameter : drift.parameters) {
    EXPECT_TRUE(parameter.follows.empty()) << parameter.name;
    for (std::size_t k = 0; k < parameter.change.size(); ++k) {
      EXPECT_LT(std::fabs(parameter.change[k]), 5.0 * parameter.std_error[k]) << parameter.name << " " << k;
    }
  }
}

TEST(Drift, FollowsWhatTheLawLacks) {
  // The speed grows from recording to recording, so that a quadratic damping shows as an order of recording.
  const Drift drift = drift_with({"quadratic-damping"}, {{"quadratic-damping.d2", 8000.0}});
  const auto c0 = std::ranges::find(drift.parameters, "c0", &DriftOfParameter::name);
  ASSERT_NE(c0, drift.parameters.end());
  EXPECT_EQ(c0->follows, "order");
  EXPECT_GT(c0->rank_correlation, 0.99);
  EXPECT_LT(c0->change.front(), -0.05);
  EXPECT_GT(c0->change.back(), 0.05);
}

}  // namespace
}  // namespace hysteron
