// Recordings that do not belong together: closed forms of the parting, devices in two states, one device that never is.
#include "diagnose/groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/column.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/residual/conditions.hpp"
#include "diagnose/residual/partition.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// q(d) = weight (d - value)^2
Quadratic parabola(double value, double weight = 1.0) {
  Quadratic result;
  result.hessian = Eigen::MatrixXd::Constant(1, 1, weight);
  result.gradient = Eigen::VectorXd::Constant(1, -weight * value);
  result.squares = weight * value * value;
  return result;
}

std::vector<Quadratic> parabolas(const std::vector<double>& values) {
  std::vector<Quadratic> result;
  for (const double value : values) {
    result.push_back(parabola(value));
  }
  return result;
}

TEST(Partition, CostsWhatAClosedFormSays) {
  // Within {1, 1.2} and {5, 5.4, 5.2}: 0.02 and 0.08; all five about their mean of 3.56: 20.272.
  const auto found = clearest_partition(parabolas({5.0, 1.0, 5.4, 1.2, 5.2}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->groups, (std::vector<Group>{{0, 2, 4}, {1, 3}}));
  EXPECT_NEAR(found->apart, 0.10, 1e-4);
  EXPECT_NEAR(found->together, 20.272, 1e-3);
  EXPECT_NEAR(found->alone, 0.0, 1e-4);
  EXPECT_NEAR(common_of(parabolas({5.0, 1.0, 5.4, 1.2, 5.2}), {0, 2, 4}).change(0), 5.2, 1e-4);
}

TEST(Partition, FindsThreeStates) {
  const auto found = clearest_partition(parabolas({1.0, 2.0, 3.0, 1.01, 2.02, 2.99, 0.99, 2.01, 3.01}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->groups, (std::vector<Group>{{0, 3, 6}, {1, 4, 7}, {2, 5, 8}}));
  EXPECT_LE(found->chance, surely);
}

TEST(Partition, IsExplainedByChanceWhereParametersScatter) {
  // Normal, even, and with one recording far out: of 60 draws of each none should pass, two may by bad luck.
  std::array<int, 3> passed{};
  for (std::uint64_t n = 0; n < 60; ++n) {
    std::array<std::vector<Quadratic>, 3> sets;
    for (std::uint64_t k = 0; k < 9; ++k) {
      const Stream stream = Stream(n).child(k);
      const double weight = 0.2 + stream.uniform(0);
      sets[0].push_back(parabola(stream.normal(1), weight));
      sets[1].push_back(parabola(stream.uniform(2), weight));
      sets[2].push_back(parabola(k == 0 ? 30.0 : stream.normal(3), weight));
    }
    for (std::size_t kind = 0; kind < sets.size(); ++kind) {
      const auto found = clearest_partition(sets[kind]);
      passed[kind] += found && found->chance <= surely ? 1 : 0;
    }
  }
  EXPECT_LE(passed[0], 2);
  EXPECT_LE(passed[1], 2);
  EXPECT_LE(passed[2], 2);
}

TEST(Partition, SaysWhichParameterDiffers) {
  std::vector<Quadratic> quadratics;
  for (const double value : {1.0, 4.0, 1.0, 4.0}) {
    const Eigen::Vector2d at(3.0, value);
    Quadratic row;
    row.hessian = Eigen::Matrix2d{{2.0, 0.5}, {0.5, 1.0}};
    row.gradient = -row.hessian * at;
    row.squares = at.dot(row.hessian * at);
    quadratics.push_back(row);
  }
  const std::vector<double> costs = cost_of_sharing(quadratics, {{0, 2}, {1, 3}});
  EXPECT_NEAR(costs[0], 0.0, 1e-3);
  // The first parameter gives way to the second: what stays of its curvature is 1 - 0.5^2 / 2, over 2 (1.5^2) a group.
  EXPECT_NEAR(costs[1], 4.0 * 2.25 * 0.875, 1e-2);
  Eigen::MatrixXd both(4, 2);
  both << 1.0, 1.0, 1.0, -1.0, 1.0, 1.0, 1.0, -1.0;
  EXPECT_NEAR(along(quadratics, both).squares, 0.0, 1e-3);
}

TEST(Conditions, OfFewLevelsExplainAnyFunctionOfTheirs) {
  // 1 at the ends of the drive and 2 in its middle: two tight groups, and a law of the drive.
  const RecordedCondition drive{"drive", {0.0, 0.5, 1.0, 0.6, 0.0, 0.5, 1.0, 0.6}};
  const std::vector<Quadratic> bent = parabolas({1.0, 2.0, 1.0, 2.0, 1.01, 2.01, 1.01, 2.01});
  EXPECT_LE(squares_followed(bent, {drive}), clearest_partition(bent)->apart + 1e-9);
  // The same values at other drives follow nothing.
  const std::vector<Quadratic> mixed_up = parabolas({1.0, 2.0, 2.0, 1.0, 2.01, 1.01, 1.01, 2.01});
  EXPECT_GT(squares_followed(mixed_up, {drive}), 100.0 * clearest_partition(mixed_up)->apart);
}

TEST(Conditions, AColumnThatTheParametersFollowIsTold) {
  const std::vector<double> oil = {41.0, 22.0, 35.0, 28.0, 20.0, 38.0, 25.0, 32.0};
  std::vector<double> values;
  for (const double degrees : oil) values.push_back(100.0 - degrees);
  const RecordedCondition column{"oil [degC]", oil, false, 0.0, true};
  const RecordedCondition stroke{"stroke", {1.0, 3.0, 2.0, 4.0, 1.5, 3.5, 2.5, 4.5}, true, 0.0, false};
  const auto told = followed_column(parabolas(values), {stroke, column});
  ASSERT_TRUE(told);
  EXPECT_EQ(told->name, "oil [degC]");
  EXPECT_EQ(told->low, 20.0);
  EXPECT_EQ(told->high, 41.0);
  EXPECT_NEAR(told->change(0), -21.0, 0.1);
  EXPECT_NEAR(told->along, 0.0, 1e-3 * told->together);
  EXPECT_NEAR(told->cost(0), told->together - told->along, 0.1 * told->together);
  EXPECT_LE(told->chance, 0.005);
  // What the stroke explains as well is no matter of the oil.
  const RecordedCondition like{"stroke", oil, false, 0.0, false};
  EXPECT_FALSE(followed_column(parabolas(values), {like, column}));
  // Five recordings are too few to tell.
  const RecordedCondition few{"oil [degC]", {41.0, 22.0, 35.0, 28.0, 20.0}, false, 0.0, true};
  EXPECT_FALSE(followed_column(parabolas({59.0, 78.0, 65.0, 72.0, 80.0}), {few}));
}

TEST(Conditions, AColumnThatNothingFollowsIsSilent) {
  const Stream draws = Stream(17).child("columns");
  int told = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Stream stream = draws.child(k);
    std::vector<double> values;
    std::vector<RecordedCondition> columns{{"a", {}, false, 0.0, true}, {"b", {}, false, 0.0, true}};
    for (std::uint32_t r = 0; r < 10; ++r) {
      values.push_back(stream.normal(0, r));
      columns[0].value.push_back(stream.normal(1, r));
      columns[1].value.push_back(stream.uniform(2, r));
    }
    told += followed_column(parabolas(values), columns) ? 1 : 0;
  }
  EXPECT_LE(told, 4) << "one in two hundred";
}

// Sines of a dashpot whose damping is that of each recording's state.
struct Sine {
  double damping;
  double amplitude;
  double frequency;
};
Campaign campaign_of(const std::vector<Sine>& tests, double quadratic = 0.0) {
  Campaign campaign;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    LayoutOptions made;
    made.fix = {{"c0", tests[k].damping}};
    std::vector<std::string> effects;
    if (quadratic > 0.0) {
      effects = {"quadratic-damping"};
      made.fix["quadratic-damping.d2"] = quadratic;
    }
    const Layout layout(make_model("viscous", effects), DataScale{}, made);
    Recording recording = testing::motion("r" + std::to_string(k) + ".csv", {{tests[k].amplitude, tests[k].frequency}},
                                          3.0 / tests[k].frequency, 400, 0.2 / tests[k].frequency);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(5).child(k));
    campaign.recordings.push_back(std::move(recording));
    campaign.roles.push_back(Role::unassigned);
  }
  return campaign;
}

std::optional<Belonging> belonging_in(const Campaign& campaign) {
  const Workbench bench(scale_of(campaign.recordings), {campaign.recordings, {}, {}, false}, {}, {}, 1,
                        [] { return false; });
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  return belonging_of(bench, by_recording(bench, base), base);
}

TEST(UnusedColumn, OfATemperatureThatThinsTheOilIsSaidWithItsSize) {
  const std::vector<double> oil = {41.0, 22.0, 35.0, 28.0, 20.0, 38.0, 25.0, 32.0};
  std::vector<Sine> tests;
  for (std::size_t k = 0; k < oil.size(); ++k) {
    tests.push_back({2000.0 * (1.0 - 0.01 * (oil[k] - 30.0)), 0.01 + 0.002 * static_cast<double>(k % 3),
                     1.0 + 0.5 * static_cast<double>(k % 4)});
  }
  Campaign campaign = campaign_of(tests);
  const auto told = [&] {
    const Workbench bench(scale_of(campaign.recordings), {campaign.recordings, {}, {}, false}, {}, {}, 1,
                          [] { return false; });
    return unused_column(bench, by_recording(bench, bench.from_anywhere({"viscous", {}, {}}, 2000)));
  };
  EXPECT_FALSE(told()) << "nothing else was recorded";
  for (std::size_t k = 0; k < oil.size(); ++k) campaign.recordings[k].unused = {{"oil [degC]", oil[k]}};
  const auto column = told();
  ASSERT_TRUE(column);
  ASSERT_EQ(column->changes.size(), 1U);
  EXPECT_EQ(column->changes[0].parameter, "c0");
  EXPECT_NEAR(column->changes[0].value, -2000.0 * 0.21, 40.0);
  EXPECT_LT(column->along, 0.3 * column->together);
  EXPECT_NE(sentence_of(*column).find("from 20 to 41 damping (c0) -4"), std::string::npos) << sentence_of(*column);
}

// Two dampers, strokes and frequencies of one within those of the other.
std::vector<Sine> two_dampers(double other) {
  return {{2000.0, 0.010, 1.0}, {other, 0.012, 1.2}, {2000.0, 0.016, 2.0}, {other, 0.008, 0.8},
          {2000.0, 0.006, 1.5}, {other, 0.014, 1.8}, {2000.0, 0.020, 0.7}, {other, 0.009, 2.4}};
}

TEST(Belonging, OfTwoDampersIsTold) {
  for (const double other : {2300.0, 2600.0, 4000.0}) {
    const std::optional<Belonging> found = belonging_in(campaign_of(two_dampers(other)));
    ASSERT_TRUE(mixed(found)) << other;
    EXPECT_EQ(found->groups, (std::vector<std::vector<std::string>>{{"r0.csv", "r2.csv", "r4.csv", "r6.csv"},
                                                                    {"r1.csv", "r3.csv", "r5.csv", "r7.csv"}}));
    ASSERT_FALSE(found->differences.empty());
    EXPECT_EQ(found->differences[0].parameter, "c0");
    EXPECT_NEAR(found->differences[0].values[0], 2000.0, 20.0);
    EXPECT_NEAR(found->differences[0].values[1], other, 20.0);
    EXPECT_LT(found->apart, 0.5 * found->together);
  }
}

TEST(Belonging, OfOneDamperIsNeverDoubted) {
  EXPECT_FALSE(mixed(belonging_in(campaign_of(two_dampers(2000.0)))));
  // What the law lacks makes the damping of each recording follow its speed.
  EXPECT_FALSE(mixed(belonging_in(campaign_of(two_dampers(2000.0), 8000.0))));
}

TEST(Belonging, IsNotDoubtedWhereAConditionExplainsIt) {
  // Another damping at every small stroke is a law of the stroke as well as another damper.
  const std::vector<Sine> tests = {{2600.0, 0.004, 1.0}, {2000.0, 0.016, 1.2}, {2600.0, 0.005, 2.0},
                                   {2000.0, 0.014, 0.8}, {2600.0, 0.003, 1.5}, {2000.0, 0.018, 1.8}};
  const std::optional<Belonging> found = belonging_in(campaign_of(tests));
  EXPECT_FALSE(mixed(found));
}

TEST(Belonging, IsDoubtedWhereTheSameMotionGivesOtherForces) {
  // A setting that goes through many values: no two groups stand out, and no function of the motion gives them all.
  std::vector<Sine> tests;
  for (const double damping : {1000.0, 2600.0, 1500.0, 3000.0, 1200.0, 2000.0}) {
    tests.push_back({damping, 0.01, 1.0});
    tests.push_back({damping, 0.006, 2.0});
  }
  const std::optional<Belonging> found = belonging_in(campaign_of(tests));
  ASSERT_TRUE(mixed(found));
  EXPECT_LT(found->apart, 0.3 * found->together);
  for (const std::vector<std::string>& group : found->groups) {
    EXPECT_EQ(group.size() % 2, 0U);  // the two motions of a setting stay together
  }
}

TEST(Belonging, LeavesNoName) {
  const Campaign campaign = campaign_of(two_dampers(3000.0));
  DiagnoseOptions options;
  options.model = "viscous";
  options.candidates = {"quadratic-damping", "coulomb-friction"};
  options.most_effects = 1;
  const auto diagnosis = diagnose(campaign, options, [](double, const std::string&) {});
  EXPECT_TRUE(mixed(diagnosis->belonging));
  EXPECT_EQ(diagnosis->verdict.answer, Answer::unattributed);
  EXPECT_TRUE(diagnosis->verdict.effects.empty());
  EXPECT_NE(diagnosis->verdict.reason.find("not of one device state"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
