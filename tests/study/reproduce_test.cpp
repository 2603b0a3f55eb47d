// Published tables: every one can be made, and the round trips bring their parameters back.
#include "study/reproduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "datasets/support/stepped_voltage.hpp"
#include "presets/support/rd8040_polynomials.hpp"
#include "study/reproduce_pso.hpp"
#include "study/run.hpp"

namespace hysteron {
namespace {

class Table : public ::testing::TestWithParam<std::string> {};

// With a budget that is far too small: the numbers are poor, the table is whole.
TEST_P(Table, CanBeMade) {
  const PublishedTable* entry = find_published_table(GetParam());
  ASSERT_NE(entry, nullptr);
  const Plan plan = make_plan(entry->study({1, 12, {}}), "test");
  Store store = Store::memory();
  const RunProgress progress = run_plan(plan, store, {}, {}, {});
  ASSERT_EQ(progress.done, plan.runs.size());
  const Reproduction result = entry->result(plan, store.records(), {});
  ASSERT_FALSE(result.tables.empty());
  EXPECT_FALSE(result.findings.empty());
  EXPECT_FALSE(result.remade.empty());
  EXPECT_FALSE(result.not_remade.empty());
  for (const ReproducedPicture& picture : result.pictures) {
    EXPECT_TRUE(picture.svg.starts_with("<svg")) << picture.id;
    EXPECT_EQ(picture.svg.find("nan"), std::string::npos) << picture.id;
  }
  EXPECT_EQ(result.pictures.size(), GetParam().starts_with("figure") ? 1U : 0U);
  for (const StudyTable& table : result.tables) {
    EXPECT_FALSE(table.rows.empty()) << table.id;
    for (const auto& row : table.rows) {
      EXPECT_EQ(row.size(), table.header.size()) << table.id;
      for (const std::string& cell : row) EXPECT_EQ(cell.find("nan"), std::string::npos) << table.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Table,
                         ::testing::Values("table-v", "table-vi", "table-vii", "table-viii", "figure-6", "figure-7",
                                           "figure-8", "figure-9", "figure-10", "figure-11", "least-squares-table-2",
                                           "lm-table-1", "nelder-mead-tables", "review-polynomials"),
                         [](const auto& row) {
                           std::string name = row.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// What `list tables` names is what is tested above.
TEST(Tables, AreAllTested) { EXPECT_EQ(published_tables().size(), 14U); }

// Table V of so many conditions and seeds, by runs that are far too short.
Reproduction table_v_of(std::size_t conditions, std::size_t seeds) {
  const PublishedTable* entry = find_published_table("table-v");
  Study study = entry->study({seeds, 12, {}});
  study.data.front().only.resize(conditions);
  const Plan plan = make_plan(study, "test");
  Store store = Store::memory();
  EXPECT_EQ(run_plan(plan, store, {}, {}, {}).done, plan.runs.size());
  return entry->result(plan, store.records(), {});
}

// Two seeds of a case give a p of 0.5 at best: that nothing is shown says nothing.
TEST(TableV, SaysThatFewSeedsOrConditionsCannotTell) {
  for (const auto& [conditions, seeds, says] :
       {std::tuple{std::size_t{1}, std::size_t{2}, "Over 2 seeds of the one condition"},
        std::tuple{std::size_t{6}, std::size_t{2}, "Over 6 conditions, each with its medians"}}) {
    const Reproduction result = table_v_of(conditions, seeds);
    EXPECT_NE(result.findings[0].find("of a single case 2 seeds cannot show a difference"), std::string::npos);
    EXPECT_TRUE(result.findings[1].starts_with(says)) << result.findings[1];
    EXPECT_NE(result.findings[1].find("so few cannot show a difference, whatever they are, which takes 7"),
              std::string::npos)
        << result.findings[1];
    for (const std::string& finding : result.findings) EXPECT_EQ(finding.find("not confirmed"), std::string::npos);
    for (const auto& row : result.tables.front().rows) {
      EXPECT_EQ(row[5], "-");
      EXPECT_EQ(row[6], "cannot tell");
    }
  }
}

TEST(TableV, TestsWhatCanBeTold) {
  const Reproduction result = table_v_of(1, 7);
  EXPECT_NE(result.findings[0].find("after Holm's correction"), std::string::npos) << result.findings[0];
  EXPECT_NE(result.findings[1].find("(Wilcoxon p = "), std::string::npos) << result.findings[1];
}

// The sentence follows from the numbers: those of results/reproduce, a surface that reaches the noise too, and budgets
// that are too small.
TEST(Figure9, SaysOfTheThirdOrderWhatTheNumbersSay) {
  using reproduce::pso::sentence_of_third_order;
  const auto says = [](double through, double jointly, const char* words) {
    return sentence_of_third_order(through, jointly).find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(0.032, 0.0098, "is not the order"));
  EXPECT_TRUE(says(0.012, 0.0098, "comes near it"));
  const double none = std::numeric_limits<double>::infinity();
  for (const auto& [through, jointly] : {std::pair{0.032, 0.03}, std::pair{0.3, none}, std::pair{none, 0.2}}) {
    EXPECT_TRUE(says(through, jointly, "nothing follows")) << through << " " << jointly;
    EXPECT_FALSE(says(through, jointly, "is not the order"));
  }
}

// What is worked out behind its runs takes as long as they do.
TEST(Figure9, TellsHowFarItIsAndEndsWhereItIsStopped) {
  const PublishedTable* entry = find_published_table("figure-9");
  Plan plan = make_plan(entry->study({1, 12, {}}), "test");
  Store store = Store::memory();
  ASSERT_EQ(run_plan(plan, store, {}, {}, {}).done, plan.runs.size());
  std::vector<double> shares;
  static_cast<void>(entry->result(plan, store.records(), [&](double share) { shares.push_back(share); }));
  EXPECT_GE(shares.size(), 9U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  ASSERT_FALSE(shares.empty());
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_GT(shares.back(), 0.8);
  plan.study.objective.stopped = [] { return true; };
  EXPECT_THROW(static_cast<void>(entry->result(plan, store.records(), {})), Stopped);
}

// Within an evaluation too, which may take long; what was stopped has no record.
TEST(Runs, EndWithinAnEvaluation) {
  const Plan plan = make_plan(find_published_table("table-viii")->study({1, 12, {}}), "test");
  const Objectives stopped(plan, plan.runs.front().problem, [] { return true; });
  const Objectives free(plan, plan.runs.front().problem);
  EXPECT_FALSE(do_run(plan, plan.runs.front(), stopped, {}).has_value());
  EXPECT_TRUE(do_run(plan, plan.runs.front(), free, {}).has_value());
}

// One current of the round trip without noise: the published parameters must come back.
TEST(RoundTrip, BringsThePublishedParametersBack) {
  const PublishedTable* entry = find_published_table("least-squares-table-2");
  Study study = entry->study({2, 1500, {}});
  study.data.resize(1);
  study.data.front().made.resize(1);
  const Plan plan = make_plan(study, "test");
  Store store = Store::memory();
  ASSERT_EQ(run_plan(plan, store, {}, {}, {}).done, 4U);
  const auto records = store.records();
  const std::size_t problem = reproduce::problem_index(plan, "stage 2 @ clean/0.00A");
  ASSERT_LT(problem, plan.problems.size());
  const RunRecord* best = reproduce::best_run(plan, records, problem);
  ASSERT_NE(best, nullptr);
  const auto p = nlohmann::json::parse(best->parameters);
  // Row of 0 A: alpha 15.71, A 3507.8, beta -1013.6, gamma 1235.8, n 1.01, c0 33.78, k0 75.04.
  const double sum = -1013.6 + 1235.8;
  const double z = std::pow(3507.8 / sum, 1.0 / 1.01);
  EXPECT_NEAR(p.at("alpha").get<double>() / (15.71 * z), 1.0, 1e-3);
  EXPECT_NEAR(p.at("x_y").get<double>() / (z / 3507.8), 1.0, 1e-3);
  EXPECT_NEAR(p.at("share").get<double>() / (1235.8 / sum), 1.0, 1e-3);
  EXPECT_NEAR(p.at("k0").get<double>() / 75.04, 1.0, 0.02);
}

// The published parameters of all 55 conditions lie inside the box that tables V to VIII search.
TEST(Box, HoldsWhatThePaperFound) {
  const Plan plan = make_plan(find_published_table("table-viii")->study({1, 12, {}}), "test");
  ASSERT_EQ(plan.problems.size(), 55U);
  std::size_t negative = 0;
  for (const StudyProblem& problem : plan.problems) {
    const double f = std::stod(problem.recordings.front().file);
    const double i = problem.recordings.front().drive.front();
    const double gamma = rd8040::gamma(i, f);
    const double sum = rd8040::beta(i, f) + gamma;
    const std::map<std::string, double> truth{{"alpha", 80.0 * rd8040::A(i, f) / sum},
                                              {"x_y", 1.0 / sum},
                                              {"share", gamma / sum},
                                              {"k0", rd8040::k0(i, f)},
                                              {"k1", rd8040::k1(i, f)},
                                              {"c0", rd8040::c0(i, f)},
                                              {"c1", rd8040::c1(i, f)},
                                              {"offset-force.f0", rd8040::f0(i, f)}};
    negative += rd8040::k0(i, f) < 0.0 ? 1 : 0;
    const Layout& layout = problem.layout;
    EXPECT_EQ(layout.dimension(), truth.size());
    for (const Coordinate& at : layout.coordinates()) {
      const std::string& name = layout.names()[at.parameter];
      EXPECT_GT(truth.at(name), at.lower) << problem.label << " " << name;
      EXPECT_LT(truth.at(name), at.upper) << problem.label << " " << name;
    }
  }
  EXPECT_EQ(negative, 45U);
}

// The swarm "as published" is informed by all of its particles, and is not what the program ships.
TEST(Swarm, AsPublishedIsTheWholeOne) {
  const Study study = find_published_table("table-v")->study({1, 10000, {}});
  ASSERT_EQ(study.solvers.size(), 3U);
  EXPECT_EQ(study.solvers[0].settings.at("topology"), 0.0);
  EXPECT_EQ(study.solvers[0].settings.at("population"), 100.0);
  EXPECT_EQ(study.solvers[1].id, "ga");
  EXPECT_TRUE(study.solvers[2].settings.empty());
  EXPECT_TRUE(study.solvers[2].shipped);
}

// Two routes to one force: steps of voltage through the exact lag of the generator, and through the effect.
TEST(VoltageTwin, IsBoucWenBehindALagOfTheDrive) {
  const Campaign campaign = stepped_voltage_campaign(rd8040_1, 0.0, Stream(1));
  ASSERT_EQ(campaign.recordings.size(), 4U);
  EXPECT_EQ(campaign.roles.back(), Role::validate);
  const CompositeModel model = make_model("bouc-wen", {"coil-lag"});
  const auto names = model.parameter_names();
  const auto index = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const double sum = rd8040_1.beta + rd8040_1.gamma;
  const double z = std::pow(rd8040_1.A / sum, 1.0 / rd8040_1.n);
  const std::vector<Term> terms{{index("alpha"), 0, 0, rd8040_1.alpha_a * z},
                                {index("alpha"), 1, 0, rd8040_1.alpha_b * z},
                                {index("c0"), 0, 0, rd8040_1.c0a},
                                {index("c0"), 1, 0, rd8040_1.c0b},
                                {index("k0"), 0, 0, rd8040_1.k0},
                                {index("f0"), 0, 0, -rd8040_1.k0 * rd8040_1.x0},
                                {index("x_y"), 0, 0, z / rd8040_1.A},
                                {index("share"), 0, 0, rd8040_1.gamma / sum},
                                {index("n"), 0, 0, rd8040_1.n},
                                {index("coil-lag.tau"), 0, 0, 1.0 / rd8040_1.eta},
                                {index("coil-lag.r"), 0, 0, 1.0}};
  ObjectiveOptions options;
  options.tolerance = 1e-8;
  for (const Recording& recording : campaign.recordings) {
    const auto error = [&](double eta) {
      std::vector<Term> own = terms;
      own[9].value = 1.0 / eta;
      const auto force = predict(model, std::vector<double>(names.size()), own, make_target(recording, options));
      return score(force, recording, Normalisation::max_abs).nrmse;
    };
    EXPECT_LT(error(157.0), 1e-6) << recording.file;
    // And the lag matters: one that is a third longer is far from the force.
    EXPECT_GT(error(118.0), 1e-3) << recording.file;
  }
}

// Models of a study may be for some of its data only.
TEST(Plan, ModelsKeepToTheDataTheyAreFor) {
  const Plan plan = make_plan(find_published_table("lm-table-1")->study({1, 12, {}}), "test");
  EXPECT_EQ(plan.problems.size(), 8U);
  for (const StudyProblem& problem : plan.problems) {
    EXPECT_EQ(problem.model == "bouc-wen+coil-lag", problem.data.find("steps") != std::string::npos) << problem.label;
  }
}

}  // namespace
}  // namespace hysteron
