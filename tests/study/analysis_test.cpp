// The analysis of a study of three solvers whose costs are set by hand.
#include "study/analysis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/study.hpp"
#include "study/export.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr std::size_t seeds = 10;

// Solver a ends at 0.1 after 50 evaluations, b within the tie of it after 80, c at twice that, on one problem.
struct Made {
  json plan;
  std::vector<RunRecord> records;
};

Made make() {
  Made made;
  made.plan = {{"title", "by hand"}, {"normalisation", "max-abs"}, {"weighting", "per-recording"},  {"tolerance", 1e-4},
               {"start", "random"},  {"targets", {1.01, 3.0}},     {"target_nrmse", json::array()}, {"tie", 1e-3},
               {"budgets", {100}}};
  for (std::size_t k = 1; k <= seeds; ++k) made.plan["seeds"].push_back(k);
  for (const char* label : {"a", "b", "c"})
    made.plan["solvers"].push_back({{"label", label}, {"id", label}, {"settings", json::object()}});
  made.plan["problems"].push_back({{"label", "m @ d"},
                                   {"model", "m"},
                                   {"data", "d"},
                                   {"hash", "h"},
                                   {"dimension", 4},
                                   {"samples", 10},
                                   {"recordings", json::array({json{{"file", "f"}, {"sha256", "s"}}})},
                                   {"heldout", json::array()}});
  for (std::size_t k = 1; k <= seeds; ++k) {
    for (std::size_t s = 0; s < 3; ++s) {
      RunRecord record;
      record.key = std::to_string(k) + "-" + std::to_string(s);
      const double final_cost = s == 2 ? 0.2 : 0.1 * (1.0 + 1e-4 * static_cast<double>(s));
      record.nrmse = final_cost;
      record.evaluations = 100;
      record.parameters = "{}";
      record.stopped = "budget";
      record.trace = {{1, 1.0}, {s == 0 ? 50U : 80U, final_cost}};
      made.records.push_back(record);
      made.plan["runs"].push_back({{"key", record.key}, {"problem", 0}, {"solver", s}, {"budget", 100}, {"seed", k}});
    }
  }
  return made;
}

// The problem again with another model, each of its runs changed by `change(first, second)`.
template <class Change>
void add_model(Made& made, Change change) {
  json other = made.plan["problems"][0];
  other["label"] = "n @ d";
  other["model"] = "n";
  made.plan["problems"].push_back(other);
  const std::size_t first = made.records.size();
  for (std::size_t k = 0; k < first; ++k) {
    RunRecord record = made.records[k];
    record.key += "-n";
    change(made.records[k], record);
    json run = made.plan["runs"][k];
    run["key"] = record.key;
    run["problem"] = 1;
    made.plan["runs"].push_back(run);
    made.records.push_back(record);
  }
}

// A second problem whose best run has a parameter on the end of its range, where c is best.
TEST(Analysis, RanksApartWhereTheBestPointLiesOnTheBox) {
  Made made = make();
  made.plan["problems"][0]["box"] = {{"p", {0.0, 1.0}}, {"q", {-1.0, 1.0}}};
  add_model(made, [](RunRecord& one, RunRecord& other) {
    one.parameters = R"({"p": 0.3, "q": 0.0})";
    other.parameters = R"({"p": 1.0, "q": 0.2})";
    other.nrmse = 0.3 - *one.nrmse;
  });
  const json analysis = analyse(made.plan, made.records);
  EXPECT_TRUE(analysis.at("problems")[0].at("best").at("on_box").empty());
  EXPECT_EQ(analysis.at("problems")[1].at("best").at("on_box"), json::array({"p"}));
  EXPECT_EQ(analysis.at("ranking").at("blocks"), 2);
  const json& inside = analysis.at("ranking_inside");
  const json& on_box = analysis.at("ranking_on_box");
  // One problem each, so that its seeds are the blocks.
  EXPECT_EQ(inside.at("block"), "seed");
  EXPECT_EQ(inside.at("rows").front().at("solver"), 0);
  EXPECT_EQ(on_box.at("rows").front().at("solver"), 2);
  std::size_t rankings = 0;
  for (const StudyTable& table : study_tables(analysis, nullptr)) rankings += table.id.starts_with("ranking") ? 1U : 0U;
  EXPECT_EQ(rankings, 3U);
  // Without ranges nothing is known of the place.
  for (json& problem : made.plan["problems"]) problem.erase("box");
  EXPECT_FALSE(analyse(made.plan, made.records).contains("ranking_inside"));
}

// A second model on the same data, worse on the fitted recordings and better on the held-out ones.
TEST(Analysis, RanksModelsByHeldOutRecordings) {
  Made made = make();
  EXPECT_TRUE(analyse(made.plan, made.records).at("models").empty());
  add_model(made, [](RunRecord& one, RunRecord& other) {
    one.nrmse_heldout = *one.nrmse + 0.5;
    other.nrmse = *one.nrmse + 0.1;
    other.nrmse_heldout = *other.nrmse + 0.05;
  });
  const json rows = analyse(made.plan, made.records).at("models");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("model"), "n");
  EXPECT_EQ(rows[0].at("solver"), 0);
  EXPECT_EQ(rows[0].at("ranked_by"), "held-out");
  EXPECT_DOUBLE_EQ(rows[0].at("median"), 0.2);
  EXPECT_DOUBLE_EQ(rows[0].at("heldout_median"), 0.25);
  EXPECT_DOUBLE_EQ(rows[1].at("heldout_median"), 0.6);
  for (RunRecord& record : made.records) record.nrmse_heldout.reset();
  EXPECT_EQ(analyse(made.plan, made.records).at("models")[0].at("model"), "m");
}

TEST(Analysis, CallsATieATie) {
  const Made made = make();
  const json analysis = analyse(made.plan, made.records);
  const json& rows = analysis.at("ranking").at("rows");
  EXPECT_EQ(rows[0].at("mean_rank"), 1.5);
  EXPECT_EQ(rows[1].at("mean_rank"), 1.5);
  EXPECT_EQ(rows[2].at("mean_rank"), 3.0);
  EXPECT_EQ(rows[0].at("place"), 1);
  EXPECT_EQ(rows[1].at("place"), 1);
  EXPECT_EQ(rows[2].at("place"), 3);
  // Ranks 1.5, 1.5, 3 in ten blocks: sums 15, 15, 30 about 20; sum of squared ranks 135 - 120 = 15; 2 * 150 / 15 = 20.
  EXPECT_DOUBLE_EQ(analysis.at("ranking").at("chi_squared"), 20.0);
  EXPECT_NEAR(analysis.at("ranking").at("p").get<double>(), std::exp(-10.0), 1e-15);
  EXPECT_EQ(study_verdict(analysis).find("a, b share the first place"), 0U);
}

TEST(Analysis, PairsAreTestedAndCorrected) {
  const Made made = make();
  const json pairs = analyse(made.plan, made.records).at("pairs");
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].at("ties"), seeds);
  EXPECT_EQ(pairs[0].at("verdict"), "tie");
  // Ten equal signs: 2 / 1024, times 3 by Holm.
  EXPECT_DOUBLE_EQ(pairs[1].at("p"), 2.0 / 1024.0);
  EXPECT_DOUBLE_EQ(pairs[1].at("p_holm"), 6.0 / 1024.0);
  EXPECT_EQ(pairs[1].at("verdict"), "a");
  EXPECT_NEAR(pairs[1].at("median_ratio").get<double>(), 0.5, 1e-12);
}

// The study of make() again on further problems, with costs of solver 1 multiplied by a factor a problem.
Made on_problems(const std::vector<double>& factors) {
  Made made = make();
  const std::size_t first = made.records.size();
  for (std::size_t p = 0; p < factors.size(); ++p) {
    if (p > 0) {
      json other = made.plan["problems"][0];
      other["label"] = "m @ d" + std::to_string(p);
      made.plan["problems"].push_back(other);
    }
    for (std::size_t k = 0; k < first; ++k) {
      const double factor = made.plan["runs"][k].at("solver") == 1 ? factors[p] : 1.0;
      if (p == 0) {
        made.records[k].nrmse = *made.records[k].nrmse * factor;
        continue;
      }
      RunRecord record = made.records[k];
      record.key += "-" + std::to_string(p);
      record.nrmse = *record.nrmse * (made.plan["runs"][k].at("solver") == 1 ? factors[p] / factors[0] : 1.0);
      json run = made.plan["runs"][k];
      run["key"] = record.key;
      run["problem"] = p;
      made.plan["runs"].push_back(run);
      made.records.push_back(record);
    }
  }
  return made;
}

// Ten seeds on each of two problems are two blocks, not twenty: nothing can be shown with them.
TEST(Analysis, ProblemsAreTheBlocks) {
  const Made made = on_problems({1.5, 1.5});
  const json analysis = analyse(made.plan, made.records);
  EXPECT_EQ(analysis.at("ranking").at("blocks"), 2);
  EXPECT_EQ(analysis.at("ranking").at("block"), "problem");
  EXPECT_EQ(analysis.at("ranking").at("different"), false);
  for (const json& row : analysis.at("ranking").at("rows")) EXPECT_EQ(row.at("place"), 1);
  EXPECT_EQ(study_verdict(analysis).find("No difference"), 0U);
  for (const json& pair : analysis.at("pairs")) EXPECT_EQ(pair.at("verdict"), "tie");
  EXPECT_NE(analysis.at("warnings").dump().find("add problems"), std::string::npos);
}

TEST(Analysis, ManyProblemsTellSolversApart) {
  const Made made = on_problems(std::vector<double>(12, 1.5));
  const json analysis = analyse(made.plan, made.records);
  EXPECT_EQ(analysis.at("ranking").at("blocks"), 12);
  EXPECT_EQ(analysis.at("ranking").at("different"), true);
  // Ranks 1, 2, 3 in every one of 12 blocks: the largest chi-squared there is, N (k - 1).
  EXPECT_DOUBLE_EQ(analysis.at("ranking").at("chi_squared"), 24.0);
}

// The interval is that of problems, and small differences are called equal.
TEST(Analysis, DifferencesHaveIntervalsAndARegionOfEquivalence) {
  const auto pair = [](const std::vector<double>& factors) {
    const Made made = on_problems(factors);
    return analyse(made.plan, made.records).at("pairs")[0];
  };
  const json clear = pair({2.0, 2.0, 2.0, 2.0});
  // make() sets solver 1 apart from solver 0 by a ten-thousandth.
  EXPECT_NEAR(clear.at("mean_ratio").get<double>(), 0.5, 1e-3);
  EXPECT_EQ(clear.at("practical"), "a");
  EXPECT_DOUBLE_EQ(clear.at("share_a_better"), 1.0);
  EXPECT_EQ(pair({1.01, 1.02, 1.01, 1.02}).at("practical"), "equal");
  const json mixed = pair({4.0, 0.25, 4.0, 0.25, 4.0, 0.25});
  EXPECT_EQ(mixed.at("practical"), "undecided");
  EXPECT_NEAR(mixed.at("mean_ratio").get<double>(), 1.0, 1e-3);
  // Six draws of +-log 4: the mean has a standard deviation of log 4 / sqrt 6, and 95 % are within two thirds of log 4.
  EXPECT_NEAR(std::log(mixed.at("ratio_high").get<double>()), std::log(4.0) * 2.0 / 3.0, 0.05);
}

TEST(Analysis, TargetsCountEvaluations) {
  const Made made = make();
  const json rows = analyse(made.plan, made.records).at("fixed_target");
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_DOUBLE_EQ(rows[0].at("ert"), 50.0);
  EXPECT_DOUBLE_EQ(rows[1].at("ert"), 80.0);
  EXPECT_TRUE(rows[2].at("ert").is_null());
  EXPECT_DOUBLE_EQ(rows[2].at("spent"), 1000.0);
  EXPECT_EQ(rows[2].at("successes"), 0);
  EXPECT_DOUBLE_EQ(rows[5].at("ert"), 80.0);
  const json ecdf = analyse(made.plan, made.records).at("ecdf");
  EXPECT_DOUBLE_EQ(ecdf.at("share")[0].back(), 1.0);
  EXPECT_LT(ecdf.at("share")[2].back(), 1.0);
}

TEST(Analysis, MissingAndFailedRunsAreSaid) {
  Made made = make();
  made.records.pop_back();
  made.records.front().nrmse.reset();
  made.records.front().trace.clear();
  const json analysis = analyse(made.plan, made.records);
  EXPECT_EQ(analysis.at("done"), 29);
  EXPECT_EQ(analysis.at("ranking").at("blocks"), 9);
  const std::string warnings = analysis.at("warnings").dump();
  EXPECT_NE(warnings.find("1 of 30 runs are missing"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("1 runs found no candidate"), std::string::npos) << warnings;
  // Every form of the report can be written of it.
  for (const std::string& text :
       {study_terminal(analysis, nullptr), study_markdown(analysis, nullptr), study_latex(analysis, nullptr)}) {
    EXPECT_EQ(text.find("nan"), std::string::npos);
  }
  EXPECT_NE(study_html(analysis, nullptr).find("<html"), std::string::npos);
}

void fail(RunRecord& record) {
  record.nrmse.reset();
  record.trace.clear();
}

// Solver 1 fails on the second of four problems and is far worse than solver 0 on the others.
TEST(Analysis, AFailedRunIsWorseThanAnyRatio) {
  Made made = on_problems({1e8, 1e8, 1e8, 1e8});
  for (std::size_t k = 0; k < made.records.size(); ++k) {
    const json& run = made.plan["runs"][k];
    if (run.at("solver") == 1 && run.at("problem") == 1) fail(made.records[k]);
  }
  const json analysis = analyse(made.plan, made.records);
  const json& pair = analysis.at("pairs")[0];
  // The failed problem has the highest of four ranks, 4 + 3 * 2 = 10 as without it, and makes no ratio smaller.
  EXPECT_DOUBLE_EQ(pair.at("w_minus"), 10.0);
  EXPECT_TRUE(pair.at("mean_ratio").is_null());
  EXPECT_TRUE(pair.at("ratio_low").is_null());
  EXPECT_LT(pair.at("ratio_high").get<double>(), 1e-7);
  EXPECT_EQ(pair.at("problems_infinite"), 1);
  EXPECT_EQ(pair.at("practical"), "a");
  EXPECT_LT(pair.at("median_ratio").get<double>(), 1e-7);
  EXPECT_FALSE(analysis.at("pairs")[1].contains("problems_infinite"));
  EXPECT_NE(study_markdown(analysis, nullptr).find("- (1 failed)"), std::string::npos);
}

// A solver with finite costs that are 10^8 times those of another, which fails on half of the problems: the failures
// are the largest differences.
TEST(Analysis, FailuresAreTheLargestDifferencesOfAPairedTest) {
  Made made = on_problems({1e8, 1e8, 1e8, 1e8});
  for (std::size_t k = 0; k < made.records.size(); ++k) {
    const json& run = made.plan["runs"][k];
    if (run.at("solver") == 0 && run.at("problem") >= 2) fail(made.records[k]);
  }
  const json pair = analyse(made.plan, made.records).at("pairs")[0];
  EXPECT_DOUBLE_EQ(pair.at("w_plus"), 3.5 + 3.5);
  EXPECT_DOUBLE_EQ(pair.at("w_minus"), 1.5 + 1.5);
  EXPECT_TRUE(pair.at("mean_ratio").is_null());
  EXPECT_TRUE(pair.at("median_ratio").is_null());
  EXPECT_EQ(pair.at("problems_infinite"), 2);
  EXPECT_EQ(pair.at("practical"), "undecided");
}

TEST(Analysis, RunsThatEvaluatedNothingSayWhy) {
  Made made = make();
  for (RunRecord& record : made.records) {
    const bool own = record.key.ends_with("-0");
    if (!own && !record.key.ends_with("-1")) continue;
    fail(record);
    record.evaluations = 0;
    record.stopped = own ? "no mood" : "budget";
  }
  const std::string warnings = analyse(made.plan, made.records).at("warnings").dump();
  EXPECT_NE(
      warnings.find("m @ d: 10 runs of a evaluated nothing (it stopped before the first: no mood); they rank last"),
      std::string::npos)
      << warnings;
  EXPECT_NE(warnings.find("10 runs of b evaluated nothing (the budget of 100 evaluations is too small for its first "
                          "point); they rank last"),
            std::string::npos)
      << warnings;
  EXPECT_EQ(warnings.find("no candidate"), std::string::npos) << warnings;
}

// A reader of the format sees runs: one that is left out has not failed.
TEST(Analysis, FailedRunsAreExportedAsRunsWithoutImprovement) {
  Made made = make();
  fail(made.records[0]);
  made.records[3].evaluations = 0;
  fail(made.records[3]);
  const auto files = ioh_files(made.plan, made.records);
  const std::string info = files.at("a/IOHprofiler_f1.info");
  EXPECT_EQ(std::ranges::count(info, '|'), static_cast<std::ptrdiff_t>(seeds)) << info;
  EXPECT_NE(info.find(", 1:100|10000000000"), std::string::npos) << info;
  EXPECT_NE(info.find(", 2:1|10000000000"), std::string::npos) << info;
  EXPECT_EQ(files.at("a/data_f1/IOHprofiler_f1_DIM4.dat")
                .find("\"function evaluation\" \"best-so-far f(x)\"\n"
                      "1 10000000000\n100 10000000000\n"),
            0U);
}

TEST(Analysis, AnEmptyStudyIsNoError) {
  const Made made = make();
  const json analysis = analyse(made.plan, {});
  EXPECT_EQ(analysis.at("done"), 0);
  EXPECT_FALSE(study_terminal(analysis, nullptr).empty());
  EXPECT_FALSE(study_html(analysis, nullptr).empty());
}

}  // namespace
}  // namespace hysteron
