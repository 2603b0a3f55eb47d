// Laws in two stages: the weighted polynomials by hand, and a simulated campaign whose laws are known.
#include "fit/two_stage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::set_drive;
using testing::set_force;

constexpr double noise = 0.01;

std::vector<Condition> at_drives(const std::vector<double>& drives) {
  std::vector<Condition> result;
  for (const double drive : drives) result.push_back({drive, 1.0, {0}, 0.0, {}});
  return result;
}

const Parameter force_card{"f", "f", "N", "", 0.0, 1000.0, 100.0};

TEST(LawThrough, AConstantIsTheWeightedMean) {
  const ParameterLaw law{0, {0.5}, {1.0}, 0};
  const std::vector<ConditionValue> values{{100.0, 5.0}, {130.0, 10.0}};
  const std::vector<double> nodes = law_through(law, force_card, at_drives({0.0, 1.0}), values);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_NEAR(nodes[0], (100.0 / 25.0 + 130.0 / 100.0) / (1.0 / 25.0 + 1.0 / 100.0), 1e-9);
}

TEST(LawThrough, ALineIgnoresWhatTheDataDoNotDetermine) {
  const ParameterLaw law{0, {0.0, 1.0}, {1.0}, 0};
  const std::vector<ConditionValue> values{{100.0, 1.0}, {150.0, 1.5}, {900.0, {}}, {200.0, 2.0}};
  const std::vector<double> nodes = law_through(law, force_card, at_drives({0.0, 0.5, 0.7, 1.0}), values);
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_NEAR(nodes[0], 100.0, 1.0);
  EXPECT_NEAR(nodes[1], 200.0, 1.0);
}

TEST(LawThrough, NodesStayInTheBox) {
  const ParameterLaw law{0, {0.0, 1.0}, {1.0}, 0};
  const std::vector<ConditionValue> values{{10.0, 1.0}, {500.0, 1.0}};
  const std::vector<double> nodes = law_through(law, force_card, at_drives({0.2, 0.3}), values);
  EXPECT_EQ(nodes.at(0), force_card.box.lower);
  EXPECT_EQ(nodes.at(1), force_card.box.upper);
}

struct Made {
  Campaign campaign;
  Layout layout;
  IdentifyOptions options;
};

// Bouc-Wen, alpha and c0 linear in the current, over five currents and two frequencies.
Made made() {
  IdentifyOptions options;
  options.layout.by_current = {{"alpha", 1}, {"c0", 1}};
  options.layout.fix = {{"k0", 0.0}, {"f0", 0.0}, {"share", 0.5}, {"n", 1.5}};
  options.budget = 3000;
  Campaign campaign;
  const DataScale scale{1000.0, 0.02, 0.2, 0.0, 1.0, 0.0, 0.0};
  const Layout truth(make_model("bouc-wen", {}), scale, options.layout);
  const std::vector<Term> terms = truth.terms(std::vector<double>(truth.dimension(), 0.3));
  for (int k = 0; k < 5; ++k) {
    for (const double frequency : {1.0, 1.6}) {
      Recording recording =
          motion("r" + std::to_string(k) + (frequency > 1.0 ? "b" : "a") + ".csv", {{0.02, frequency}}, 2.0, 161, 0.3);
      set_drive(recording, 0.25 * k);
      std::vector<Term> here = terms;
      for (Term& term : here) {
        const bool alpha = truth.names()[term.parameter] == "alpha";
        if (term.drive_power == 1) term.value = alpha ? 600.0 : 3000.0;
      }
      set_force(recording, truth, here, {}, noise, Stream(3).child(recording.file));
      campaign.recordings.push_back(std::move(recording));
      campaign.roles.push_back(Role::unassigned);
    }
  }
  Layout layout(make_model("bouc-wen", {}), scale_of(campaign.recordings), options.layout);
  return {std::move(campaign), std::move(layout), options};
}

TEST(TwoStage, FindsTheLawsOfASimulatedCampaign) {
  const Made m = made();
  std::vector<std::size_t> fitted;
  std::vector<std::size_t> heldout;
  for (std::size_t k = 0; k < m.campaign.recordings.size(); ++k) (k % 5 == 2 ? heldout : fitted).push_back(k);
  const TwoStage two =
      fit_two_stage(m.campaign, m.layout, fitted, heldout, *find_solver("multistart-lm"), m.options, {});
  EXPECT_EQ(two.conditions.size(), fitted.size());
  ASSERT_EQ(two.steps.size(), m.layout.laws().size());
  // A parameter without a law goes first.
  EXPECT_EQ(m.layout.names()[m.layout.laws()[two.steps.front().law].parameter], "x_y");
  // Every freezing takes freedom away, and the last leaves what the laws say.
  double before = two.nrmse_free;
  for (const FrozenParameter& step : two.steps) {
    EXPECT_GE(step.nrmse, before * (1.0 - 1e-6));
    before = step.nrmse;
  }
  EXPECT_NEAR(two.nrmse, two.steps.back().nrmse, 1e-9);
  ASSERT_TRUE(two.nrmse_heldout.has_value());
  EXPECT_LT(two.nrmse, 1.1 * noise);
  EXPECT_LT(*two.nrmse_heldout, 1.1 * noise);
  for (const Term& term : m.layout.terms(two.point)) {
    if (term.drive_power != 1) continue;
    const double truth = m.layout.names()[term.parameter] == "alpha" ? 600.0 : 3000.0;
    EXPECT_NEAR(term.value, truth, 0.05 * truth);
  }
  EXPECT_LE(two.evaluations, m.options.budget + 1);
}

TEST(TwoStage, RefusesFewerConditionsThanCoefficients) {
  const Made m = made();
  EXPECT_THROW(fit_two_stage(m.campaign, m.layout, {0}, {}, *find_solver("lm"), m.options, {}), InputError);
}

}  // namespace
}  // namespace hysteron
