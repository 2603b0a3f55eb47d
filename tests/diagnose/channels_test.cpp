// A lag of the velocity channel, told by the channels without a model, stays in the model and is named by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnose/search/gather.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/search.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr double lag = 3e-3;

// Sines of a Bouc-Wen damper. The velocity that is recorded, with noise, is that of `behind` s before.
std::vector<Recording> sines(double behind) {
  LayoutOptions made;
  made.fix = {{"alpha", 600.0}, {"c0", 1500.0}, {"k0", 0.0}, {"f0", 0.0}, {"x_y", 8e-4}, {"share", 0.6}, {"n", 1.5}};
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, made);
  std::vector<Recording> result;
  for (const double frequency : {0.7, 1.3, 2.6, 4.1}) {
    const double seconds = 5.0 / frequency;
    Recording recording = testing::motion("sine.csv", {{0.01, frequency}}, seconds, 800, 0.2 / frequency);
    const Stream noise = Stream(11).child(result.size());
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, noise);
    const std::vector<double> true_velocity = recording.velocity;
    const double step = recording.time[1];
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double at = std::max(0.0, static_cast<double>(n) - behind / step);
      const auto left = std::min(static_cast<std::size_t>(at), recording.size() - 2);
      const double part = at - static_cast<double>(left);
      recording.velocity[n] = (1.0 - part) * true_velocity[left] + part * true_velocity[left + 1] +
                              1e-3 * noise.child("velocity").normal(n);
    }
    result.push_back(std::move(recording));
  }
  return result;
}

TEST(Channels, TellALagOfTheVelocityAndNothingElse) {
  const std::vector<std::string> candidates = {"inertia", "sensor-delay", channel_lag};
  EXPECT_EQ(told_by_channels(sines(lag), candidates), std::vector<std::string>{channel_lag});
  EXPECT_TRUE(told_by_channels(sines(0.0), candidates).empty());
  EXPECT_TRUE(told_by_channels(sines(lag), {"inertia"}).empty()) << "what is not looked for is not told";
  std::vector<Recording> derived = sines(lag);
  for (Recording& recording : derived) recording.velocity_measured = false;
  EXPECT_TRUE(told_by_channels(derived, candidates).empty());
}

// The damper is told to be another than it is, so that other effects gain more: the lag is in the model all the same.
TEST(Channels, WhatTheyTellStaysInTheModel) {
  const std::vector<Recording> recordings = sines(lag);
  Split split;
  split.fit = recordings;
  split.judge.push_back({recordings.front(), 0});
  const Workbench bench(scale_of(recordings), split, {}, {}, 1, [] { return false; });
  SearchOptions options;
  options.candidates = {"quadratic-damping", "coulomb-friction", channel_lag};
  options.told = {channel_lag};
  options.most_effects = 2;
  options.base_budget = 2000;
  const Search found = search(bench, bench, {"bingham", {}, {}}, options, [](double, const std::string&) {});
  const auto of_lag =
      std::ranges::find_if(found.found, [](const Found& one) { return one.part.effect == channel_lag; });
  ASSERT_NE(of_lag, found.found.end());
  EXPECT_TRUE(of_lag->told);
}

}  // namespace
}  // namespace hysteron
