// Identification with effects: sizes of series elements are found again, and the drive path acts on the laws of the
// parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/identify.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::set_drive;
using testing::set_force;

constexpr std::uint64_t seed = 1807;

struct Truth {
  std::string effect;
  std::string parameter;
  double value;
  double tolerance;  // relative
  std::map<std::string, double> also = {};
};

class EffectFit : public ::testing::TestWithParam<Truth> {};

// A wider model fits no worse: a law that is not quite the damper's leaves effects with optima of their own, in which a
// fit that begins anywhere ends.
TEST(FitWithEffects, IsNoWorseThanOneWithout) {
  Campaign campaign;
  campaign.recordings = {motion("slow.csv", {{0.02, 0.7}}, 2.0, 120, 0.3),
                         motion("fast.csv", {{0.008, 2.6}}, 1.0, 120, 0.2)};
  const Layout truth(make_model("modified-bouc-wen", {}), DataScale{}, {});
  for (std::size_t r = 0; r < campaign.recordings.size(); ++r) {
    set_force(campaign.recordings[r], truth, truth.terms(truth.initial()), {}, 0.01, Stream(seed).child(r));
  }
  campaign.roles.assign(campaign.recordings.size(), Role::fit);
  IdentifyOptions options;
  options.budget = 1000;
  options.objective.threads = 2;
  const double without = identify(campaign, "bouc-wen", options, {}).cost;
  for (const char* effect : {"compliance", "series-dashpot", "stiction", "sensor-delay"}) {
    options.effects = {effect};
    const Identification with = identify(campaign, "bouc-wen", options, {});
    EXPECT_LE(with.cost, 1.001 * without) << effect;
    EXPECT_LE(with.solvers.front().run.evaluations, options.budget) << effect;
  }
}

TEST_P(EffectFit, FindsTheSizeInNoisyForces) {
  const Truth& truth = GetParam();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::vector<Recording> recordings = {motion("slow.csv", {{0.02, 0.7}}, 2.0, 120, 0.3),
                                       motion("fast.csv", {{0.008, 2.6}}, 1.0, 120, 0.2)};
  const CompositeModel model = make_model("bouc-wen", {truth.effect});
  LayoutOptions made;
  made.fix = {{"alpha", 600.0}, {"c0", 1500.0}, {"k0", 2000.0}, {"f0", 20.0},
              {"x_y", 8e-4},    {"share", 0.6}, {"n", 1.5}};
  made.fix[truth.effect + "." + truth.parameter] = truth.value;
  made.fix.insert(truth.also.begin(), truth.also.end());
  const Layout layout(model, DataScale{}, made);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    set_force(recordings[r], layout, layout.terms(layout.initial()), {}, 0.01, Stream(seed).child(r));
  }
  Campaign campaign;
  campaign.recordings = recordings;
  campaign.roles.assign(recordings.size(), Role::fit);
  IdentifyOptions options;
  options.effects = {truth.effect};
  options.budget = 1000;
  options.seed = seed;
  options.objective.threads = 2;
  const Identification result = identify(campaign, "bouc-wen", options, {});
  EXPECT_LT(result.cost, 0.0115);  // 1 % of noise
  const std::string name = truth.effect + "." + truth.parameter;
  const auto found = std::ranges::find_if(result.estimates, [&](const Estimate& e) { return e.name == name; });
  ASSERT_NE(found, result.estimates.end());
  EXPECT_NEAR(found->term.value, truth.value, truth.tolerance * truth.value);
}

// The gas is squeezed to a third of its volume; the friction turns as softly as a film lets it.
INSTANTIATE_TEST_SUITE_P(Effects, EffectFit,
                         ::testing::Values(Truth{"clearance", "gap", 1.2e-3, 0.1}, Truth{"compliance", "C", 3e-6, 0.2},
                                           Truth{"gas-spring", "g", 33.0, 0.1, {{"gas-spring.f_g", 150.0}}},
                                           Truth{
                                               "coulomb-friction", "v_t", 5e-3, 0.2, {{"coulomb-friction.fc", 150.0}}}),
                         [](const auto& instance) {
                           std::string name = instance.param.effect;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// More candidates than a pack holds are sorted by their stiffness; each gets what it gets alone, whatever the effect.
TEST(EveryEffect, ManyCandidatesGetWhatEachGetsAlone) {
  Recording recording = motion("many.csv", {{0.015, 1.3}}, 1.0, 100, 0.2);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    recording.drive.push_back(n < recording.size() / 2 ? 0.3 : 0.8);
    recording.force.push_back(800.0 * recording.velocity[n] + 5.0);
  }
  recording.drive_kind = DriveKind::current;
  LayoutOptions laws;
  laws.by_current = {{"alpha", 1}};
  for (const Part* effect : effect_catalogue()) {
    SCOPED_TRACE(effect->id);
    const Layout layout(make_model("bouc-wen", {std::string(effect->id)}), scale_of({recording}), laws);
    ObjectiveOptions options;
    options.threads = 2;
    const Objective objective(layout, {recording}, options);
    const Stream stream = Stream(seed).child(effect->id);
    Request all;
    // Two packs side by side, and two of which the second is not full, for each of two threads.
    const std::size_t count = 3 * lane_count + 3;
    for (std::size_t k = 0; k < count * layout.dimension(); ++k) all.points.push_back(0.1 + 0.8 * stream.uniform(k));
    const Response together = objective.evaluate(all);
    for (std::size_t row = 0; row < count; row += 5) {
      const auto first = all.points.begin() + static_cast<std::ptrdiff_t>(row * layout.dimension());
      Request one;
      one.points.assign(first, first + static_cast<std::ptrdiff_t>(layout.dimension()));
      EXPECT_EQ(objective.evaluate(one).cost[0], together.cost[row]);
    }
  }
}

// Force of a dashpot whose coefficient follows the drive, at constant speed: the drive that acts.
std::vector<double> acting(const std::string& effect, const std::map<std::string, double>& values,
                           const std::vector<double>& drive) {
  Recording recording;
  recording.file = "drive.csv";
  for (std::size_t n = 0; n < drive.size(); ++n) {
    recording.time.push_back(0.01 * static_cast<double>(n));
    recording.displacement.push_back(0.1 * recording.time.back());
    recording.velocity.push_back(0.1);
    recording.force.push_back(1.0);
  }
  recording.drive = drive;
  recording.drive_kind = DriveKind::current;
  const CompositeModel model = make_model("viscous", {effect});
  std::vector<double> held(model.parameter_count(), 0.0);
  const auto names = model.parameter_names();
  for (const auto& [name, value] : values) {
    held[static_cast<std::size_t>(std::ranges::find(names, effect + "." + name) - names.begin())] = value;
  }
  // c0 = 10 i: the force is the drive that acts.
  return predict(model, held, {{0, 1, 0, 10.0}}, make_target(recording, {}));
}

TEST(Drive, SaturationIsTheCurveOfTheSource) {
  std::vector<double> drive;
  for (int n = 0; n <= 30; ++n) drive.push_back(0.1 * n);
  for (const double limit : {0.7, 1.5}) {
    const auto force = acting("magnetic-saturation", {{"sigma", 1.0 / (limit * limit)}}, drive);
    for (std::size_t n = 0; n < drive.size(); ++n) {
      EXPECT_NEAR(force[n], limit * std::tanh(drive[n] / limit), 1e-9);
    }
  }
  const auto none = acting("magnetic-saturation", {{"sigma", 0.0}}, drive);
  const auto hardly = acting("magnetic-saturation", {{"sigma", 1e-6}}, drive);
  for (std::size_t n = 0; n < drive.size(); ++n) {
    EXPECT_NEAR(none[n], drive[n], 1e-12);
    const double a = 1e-6 * drive[n] * drive[n];
    EXPECT_NEAR(hardly[n], drive[n] * (1.0 - a / 3.0 + 2.0 * a * a / 15.0), 1e-14 * (1.0 + drive[n]));
  }
  // Constant drives are saturated too.
  EXPECT_NEAR(acting("magnetic-saturation", {{"sigma", 1.0}}, {2.0, 2.0, 2.0}).back(), std::tanh(2.0), 1e-12);
}

TEST(Drive, RemanencePersistsAfterAStepDown) {
  const auto force = acting("magnetic-remanence", {{"rho", 0.5}, {"w", 0.2}, {"s", 1.0}},
                            {0.5, 0.5, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 1.0, 0.5});
  const std::vector<double> theory = {0.5, 0.5, 0.9, 0.9, 1.9, 1.9, 1.1, 1.1, 1.1, 0.6};
  for (std::size_t n = 0; n < theory.size(); ++n) EXPECT_NEAR(force[n], theory[n], 1e-12) << n;
  for (const double constant : acting("magnetic-remanence", {{"rho", 0.5}, {"w", 0.2}, {"s", 1.0}}, {0.7, 0.7, 0.7})) {
    EXPECT_NEAR(constant, 0.7, 1e-12);
  }
  // Switched on from a circuit without field: 0.2 A behind, half of it felt.
  for (const double constant : acting("magnetic-remanence", {{"rho", 0.5}, {"w", 0.2}, {"s", 0.0}}, {0.7, 0.7, 0.7})) {
    EXPECT_NEAR(constant, 0.6, 1e-12);
  }
}

// After a step up from 0.4 to 1.4 and down again, each reached within the sample before it.
TEST(Drive, CoilLagIsFirstOrderSlowerWhereTheCurrentFalls) {
  std::vector<double> drive(300, 0.4);
  std::fill(drive.begin() + 50, drive.begin() + 150, 1.4);
  const double tau = 0.02;
  const double fall = 1.5;
  const auto force = acting("coil-lag", {{"tau", tau}, {"r", fall}}, drive);
  const double step = 0.01;  // s, as in `acting`
  // The response to a ramp over one sample, exactly.
  const auto behind = [&](double constant, double after) {
    return constant / step * (std::exp(step / constant) - 1.0) * std::exp(-(after + step) / constant);
  };
  for (std::size_t n = 0; n < 50; ++n) EXPECT_NEAR(force[n], 0.4, 1e-12);
  for (std::size_t n = 50; n < 150; ++n) {
    EXPECT_NEAR(force[n], 1.4 - behind(tau, static_cast<double>(n - 50) * step), 1e-9) << n;
  }
  for (std::size_t n = 150; n < 300; ++n) {
    EXPECT_NEAR(force[n], 0.4 + behind(tau * fall, static_cast<double>(n - 150) * step), 1e-9) << n;
  }
  // No lag is none.
  const auto none = acting("coil-lag", {{"tau", 0.0}, {"r", 1.0}}, drive);
  for (std::size_t n = 0; n < drive.size(); ++n) EXPECT_NEAR(none[n], drive[n], 1e-6);
}

// The force channel lags: the force belongs to the drive of before, between samples too.
TEST(Drive, SensorDelayRecallsTheDrive) {
  std::vector<double> drive(60);
  for (std::size_t n = 0; n < drive.size(); ++n) drive[n] = n < 20 ? 0.5 : 0.5 + 0.1 * static_cast<double>(n - 20);
  for (const double lag : {0.015, 0.02, -0.015}) {
    const auto force = acting("sensor-delay", {{"lag", lag}}, drive);
    for (std::size_t n = 0; n < drive.size(); ++n) {
      const double at = std::min(static_cast<double>(n) - lag / 0.01, static_cast<double>(drive.size() - 1));
      EXPECT_NEAR(force[n], 0.5 + 0.1 * std::max(at - 20.0, 0.0), 1e-9) << lag << " " << n;
    }
  }
}

// Derivatives through the drive: the gradient of the objective against differences.
TEST(Drive, GradientOfTheEffectsOnTheDrive) {
  for (const std::string effect : {"magnetic-saturation", "magnetic-remanence", "coil-lag", "sensor-delay"}) {
    Recording recording = motion("m.csv", {{0.02, 1.1}}, 1.5, 120, 0.2);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.drive.push_back(0.8 + 0.6 * std::sin(9.0 * recording.time[n]));
      recording.force.push_back(500.0 * recording.velocity[n] + 1.0);
    }
    recording.drive_kind = DriveKind::current;
    LayoutOptions options;
    options.by_current = {{"alpha", 1}, {"c0", 2}};
    const Layout layout(make_model("bouc-wen", {effect}), scale_of({recording}), options);
    const Objective objective(layout, {recording}, {});
    std::vector<double> u(layout.dimension(), 0.35);
    const Response exact = objective.evaluate({u, true});
    EXPECT_EQ(exact.cost[0], objective.evaluate({u, false}).cost[0]);
    for (std::size_t c = 0; c < u.size(); ++c) {
      const double h = 1e-6;
      std::vector<double> above = u;
      std::vector<double> below = u;
      above[c] += h;
      below[c] -= h;
      const double up = objective.evaluate({above, false}).cost[0];
      const double down = objective.evaluate({below, false}).cost[0];
      const double slope = (up * up - down * down) / (4.0 * h);
      EXPECT_NEAR(exact.gradient[c], slope, 1e-3 * std::fabs(slope) + 1e-6 * exact.cost[0] * exact.cost[0])
          << effect << " " << c;
    }
  }
}

}  // namespace
}  // namespace hysteron
