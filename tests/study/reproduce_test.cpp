// Published tables: every one can be made, and the round trips bring their parameters back.
#include "study/reproduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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
  const Reproduction result = entry->result(plan, store.records());
  ASSERT_FALSE(result.tables.empty());
  EXPECT_FALSE(result.findings.empty());
  EXPECT_FALSE(result.remade.empty());
  EXPECT_FALSE(result.not_remade.empty());
  for (const StudyTable& table : result.tables) {
    EXPECT_FALSE(table.rows.empty()) << table.id;
    for (const auto& row : table.rows) {
      EXPECT_EQ(row.size(), table.header.size()) << table.id;
      for (const std::string& cell : row) EXPECT_EQ(cell.find("nan"), std::string::npos) << table.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Table,
                         ::testing::Values("table-v", "table-vi", "table-vii", "table-viii", "figure-9",
                                           "least-squares-table-2", "lm-table-1"),
                         [](const auto& row) {
                           std::string name = row.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// One current of the round trip without noise: the published parameters must come back.
TEST(RoundTrip, BringsThePublishedParametersBack) {
  const PublishedTable* entry = find_published_table("least-squares-table-2");
  Study study = entry->study({2, 1500, {}});
  study.data.resize(1);
  study.data.front().made.resize(1);
  const Plan plan = make_plan(study, "test");
  Store store = Store::memory();
  ASSERT_EQ(run_plan(plan, store, {}, {}, {}).done, 2U);
  const auto records = store.records();
  const RunRecord* best = reproduce::best_run(plan, records, 0);
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

}  // namespace
}  // namespace hysteron
