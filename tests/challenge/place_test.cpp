// Where a change of force sits, against closed forms on a sine.
#include "challenge/place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "challenge/score.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;

constexpr double amplitude = 0.02;                      // m
constexpr double omega = 2.0 * std::numbers::pi * 1.5;  // 1/s
constexpr double speed = amplitude * omega;             // m/s

// Two recordings of a sine, 12 periods each; the change at displacement, velocity and distance since the last turn.
json places(const std::function<double(double x, double v, double since)>& change) {
  std::vector<Measured> recordings(2);
  Forces left(2);
  for (std::size_t r = 0; r < 2; ++r) {
    for (int k = 0; k < 8000; ++k) {
      const double t = 0.001 * k;
      const double turns = std::floor(omega * t / std::numbers::pi + 0.5);  // at odd quarters of a period
      const double last = (turns - 0.5) * std::numbers::pi;
      const double x = amplitude * std::sin(omega * t);
      recordings[r].time.push_back(t);
      recordings[r].x.push_back(x);
      recordings[r].v.push_back(speed * std::cos(omega * t));
      left[r].push_back(change(x, recordings[r].v.back(), std::abs(x - amplitude * std::sin(last))));
    }
  }
  return places_of(recordings, left, {1000.0, 2000.0});
}

TEST(Place, WhatIsEverywhereIsNowhereDenser) {
  const json all = places([](double, double, double) { return 3.0; });
  for (const auto& [variable, from, to] :
       {std::tuple{"speed", 0.0, 0.5 * speed}, std::tuple{"displacement", -amplitude, 0.3 * amplitude},
        std::tuple{"time", 2.0, 5.0}, std::tuple{"displacement since reversal", 0.0, 0.5 * amplitude}}) {
    EXPECT_NEAR(concentration(all, variable, from, to), 1.0, 1e-9) << variable;
  }
}

TEST(Place, WhatIsSlowIsDenserThere) {
  const double slow = 0.3 * speed;
  const json all = places([&](double, double v, double) { return std::abs(v) < slow ? 5.0 : 0.0; });
  const double share = std::asin(0.3) * 2.0 / std::numbers::pi;  // of the time
  EXPECT_NEAR(concentration(all, "speed", 0.0, slow), 1.0 / share, 0.05 / share);
  EXPECT_LT(concentration(all, "speed", 1.1 * slow, speed), 0.02);
  EXPECT_EQ(concentration(all, "speed", 2.0 * speed, 3.0 * speed), 0.0);
  EXPECT_EQ(concentration(all, "drive", 0.0, 1.0), 0.0) << "no drive was recorded";
}

TEST(Place, WhatFollowsAReversalIsDenserThere) {
  const double reach = 0.2 * amplitude;
  const json all = places([&](double, double, double since) { return since < reach ? 5.0 : 0.0; });
  const double share = std::acos(1.0 - 0.2) / std::numbers::pi;
  EXPECT_NEAR(concentration(all, "displacement since reversal", 0.0, reach), 1.0 / share, 0.15 / share);
}

TEST(Place, IsScoredByTheDensityOfTheTrueChange) {
  const json truth = {
      {"campaign", "campaign-0001"},
      {"level", "foreign"},
      {"design", "sines"},
      {"disturbance", ""},
      {"acceptable", json::array()},
      {"effects", json::array()},
      {"places", places([](double, double v, double) { return std::abs(v) < 0.3 * speed ? 5.0 : 0.0; })},
      {"noise", {{"share_of_peak", 0.01}}},
      {"floor_nrmse_heldout", 0.01}};
  const auto location = [](double from, double to) {
    return json{{"where", "somewhere"},    {"variable", "speed"},     {"from", from}, {"to", to},
                {"share_of_misfit", 0.75}, {"share_of_samples", 0.25}};
  };
  const json said = {{"verdict", "unattributed"},
                     {"effects", json::array()},
                     {"locations", {location(0.0, 0.3 * speed), location(0.6 * speed, speed)}},
                     {"baseline", {{"nrmse_heldout", 0.03}}},
                     {"augmented", {{"nrmse_heldout", 0.0105}}}};
  const json scored = score_campaign(truth, said).at("places");
  ASSERT_EQ(scored.size(), 2U);
  EXPECT_EQ(scored[0].at("stated"), 3.0);
  EXPECT_TRUE(scored[0].at("right").get<bool>());
  EXPECT_FALSE(scored[1].at("right").get<bool>());
}

}  // namespace
}  // namespace hysteron::challenge
