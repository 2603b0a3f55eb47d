#include "fit/start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/frequency.hpp"
#include "fit/objective.hpp"

namespace hysteron {
namespace {

constexpr double frequency = 2.0;

// Under way at the first sample; the force of a rate-independent damper that needs `building` seconds to build up.
Recording moving(double building, double duration = 2.0) {
  Recording recording;
  recording.file = "moving.csv";
  const double w = 2.0 * std::numbers::pi * frequency;
  for (int n = 0; n <= static_cast<int>(500.0 * duration); ++n) {
    const double t = n / 500.0;
    recording.time.push_back(t);
    recording.displacement.push_back(0.01 * std::sin(w * t));
    recording.velocity.push_back(0.01 * w * std::cos(w * t));
    const double built = building > 0.0 ? 1.0 - std::exp(-t / building) : 1.0;
    recording.force.push_back(1000.0 * built * std::tanh(10.0 * std::cos(w * t)) + 3.0 * std::sin(7.1 * n));
  }
  return recording;
}

TEST(Start, IsSeenInTheForce) {
  EXPECT_EQ(start_of(moving(0.0)), Start::in_cycle);
  EXPECT_EQ(start_of(moving(0.008)), Start::from_nothing);
  EXPECT_EQ(start_of(moving(0.008, 0.9)), Start::in_cycle);  // less than two periods
  // Built up over much of the first period: the second and the third tell.
  EXPECT_EQ(start_of(moving(0.1, 2.0)), Start::from_nothing);
  EXPECT_EQ(start_of(moving(0.1, 1.1)), Start::in_cycle);
  // Dry friction jumps at every reversal, a sample earlier or later than one period before.
  for (const double building : {0.0, 0.008}) {
    Recording jumping = moving(building);
    for (std::size_t n = 0; n < jumping.size(); ++n) {
      jumping.force[n] += std::cos(2.0 * std::numbers::pi * 2.004 * jumping.time[n]) < 0.0 ? -400.0 : 400.0;
    }
    EXPECT_EQ(start_of(jumping), building > 0.0 ? Start::from_nothing : Start::in_cycle);
  }
  Recording outlier = moving(0.0);
  outlier.force[5] = 0.0;
  EXPECT_EQ(start_of(outlier), Start::in_cycle);
  // Built up between the first sample and the second one, as of few samples a period.
  const auto first_at = [](double share) {
    Recording one = moving(0.0);
    one.force[0] *= share;
    return start_of(one);
  };
  EXPECT_EQ(first_at(0.1), Start::from_nothing);
  EXPECT_EQ(first_at(0.6), Start::from_nothing);
  EXPECT_EQ(first_at(0.0), Start::in_cycle) << "a channel that was not ready";
  EXPECT_EQ(first_at(-0.5), Start::in_cycle) << "an outlier";
  EXPECT_EQ(first_at(1.5), Start::in_cycle) << "an outlier";
  Recording motion_only = moving(0.008);
  motion_only.force.clear();
  EXPECT_EQ(start_of(motion_only), Start::in_cycle);
  // A copy of every 40th sample no longer shows it.
  Recording copy = every_kth(moving(0.008), 40);
  EXPECT_EQ(start_of(copy), Start::in_cycle);
  copy.start = Start::from_nothing;
  EXPECT_EQ(start_of(copy), Start::from_nothing);
}

// A motion that comes back to its first sample after a period, but is no periodic one, has none to march beforehand.
TEST(Start, OnlyAMotionThatRepeatsHasAPeriodBeforehand) {
  Recording steady = moving(0.0);
  EXPECT_EQ(returns_after(steady, frequency), 250u);
  Recording wandering = steady;
  for (std::size_t n = 0; n < wandering.size(); ++n) {
    const double t = wandering.time[n];
    // Both terms vanish with their slopes at the start and after one period.
    const double w = 2.0 * std::numbers::pi * frequency;
    const double away = (1.0 - std::cos(w * t)) * (1.0 - std::cos(w * t));
    wandering.displacement[n] += 0.01 * away * std::sin(0.37 * w * t);
  }
  EXPECT_EQ(returns_after(wandering, frequency), 0u);
}

// Harmonics and a second tone turn the motion between its own turns; a third tone that fits into no period of both does
// not come again.
TEST(Start, AMotionOfSeveralTonesHasAPeriodBeforehand) {
  struct Tones {
    double share, multiple, other_share, other;
    double after;
  };
  for (const Tones tones : {Tones{0.35, 3.0, 0.0, 1.0, 250},
                            {0.6, 2.0, 0.0, 1.0, 250},
                            {0.2, 7.0, 0.0, 1.0, 250},
                            {0.9, 1.5, 0.0, 1.0, 500},
                            {0.6, 2.0, 0.4, 1.37, 0}}) {
    Recording recording = moving(0.0, 3.0);
    const double w = 2.0 * std::numbers::pi * frequency;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double t = recording.time[n];
      for (const auto& [share, multiple] :
           {std::pair{tones.share, tones.multiple}, std::pair{tones.other_share, tones.other}}) {
        recording.displacement[n] += 0.01 * share * std::sin(multiple * w * t + 1.0);
        recording.velocity[n] += 0.01 * share * multiple * w * std::cos(multiple * w * t + 1.0);
      }
      recording.displacement[n] += 5e-5 * std::sin(7.1 * static_cast<double>(n));
    }
    EXPECT_NEAR(static_cast<double>(period_of(recording, dominant_frequency(recording))), tones.after, 1.0)
        << tones.multiple;
  }
}

// A recording simulated from the neutral state at full speed is predicted as it was simulated.
TEST(Start, FromNothingNothingIsMarchedBeforehand) {
  Recording recording = moving(0.0);
  const CompositeModel model = make_model("bouc-wen", {});
  std::vector<double> values;
  for (const Parameter& card : model.parameters()) values.push_back(card.initial);
  Target target = make_target(recording, {});
  EXPECT_GT(target.preroll, 0U);
  const std::vector<double> in_cycle = predict(model, values, {}, target);
  recording.start = Start::from_nothing;
  target = make_target(recording, {});
  EXPECT_EQ(target.preroll, 0U);
  recording.force = predict(model, values, {}, target);
  recording.start = Start::unknown;
  EXPECT_EQ(start_of(recording), Start::from_nothing);
  EXPECT_EQ(predict(model, values, {}, make_target(recording, {})), recording.force);
  EXPECT_GT(std::fabs(in_cycle[0] - recording.force[0]), 0.1 * std::fabs(in_cycle[0]));
  recording.force = in_cycle;
  EXPECT_EQ(start_of(recording), Start::in_cycle);
}

// The equations of these count from the first sample, whatever period is marched before it: F(0) is that of a damper
// which has neither travelled nor worked.
TEST(Start, TravelAndWorkCountFromTheFirstSample) {
  const Recording recording = moving(0.0);
  const auto first_force = [&](const std::vector<std::string>& effects, const std::vector<double>& of_effects) {
    std::vector<double> values{2000.0, 0.0, 0.0};  // c0, k0, f0
    values.insert(values.end(), of_effects.begin(), of_effects.end());
    const CompositeModel model = make_model("viscous", effects);
    const Target target = make_target(recording, {});
    EXPECT_GT(target.preroll, 0U);
    return predict(model, values, {}, target)[0] / recording.velocity[0];
  };
  const CompositeModel law = make_model("viscous", {});
  ASSERT_EQ(law.parameter_names(), (std::vector<std::string>{"c0", "k0", "f0"}));
  EXPECT_NEAR(first_force({"stiction"}, {0.5, 0.01}), 3000.0, 1e-6);
  EXPECT_NEAR(first_force({"degradation"}, {1e-3}), 2000.0, 1e-6);
  EXPECT_NEAR(first_force({"self-heating"}, {1e-3, 60.0, 1.0, 0.0}), 2000.0, 1e-6);
  // Packs of candidates go the same way.
  const std::vector<Recording> recordings{recording};
  LayoutOptions options;
  options.fix = {{"k0", 0.0}, {"f0", 0.0}};
  const CompositeModel model = make_model("viscous", {"stiction"});
  const Layout layout(model, scale_of(recordings), options);
  Recording simulated = recording;
  const std::vector<double> point(layout.dimension(), 0.5);
  simulated.force = predict(model, layout.held(), layout.terms(point), make_target(recording, {}));
  simulated.start = Start::in_cycle;
  const Objective objective(layout, {&simulated}, {});
  const std::vector<double> points = [&] {
    std::vector<double> eight;
    for (int k = 0; k < 8; ++k) eight.insert(eight.end(), point.begin(), point.end());
    return eight;
  }();
  EXPECT_LT(objective.evaluate({points, false}).cost[7], 1e-9);
}

}  // namespace
}  // namespace hysteron
