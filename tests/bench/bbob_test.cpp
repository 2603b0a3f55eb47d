// The BBOB functions: published optima and values, the value at the place of the optimum, and the log read by its
// format.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "bench/bbob_functions.hpp"
#include "bench/bbob_log.hpp"
#include "core/error.hpp"
#include "core/random.hpp"

namespace hysteron::bbob {
namespace {

// Optima of instance 1 in dimension 2 and values at (0, 0) and (1, 2), as published with another implementation; those
// of functions with a rotation were made of matrices of six digits.
struct Published {
  int number;
  double optimum, at_zero, at_one_two, tolerance;
};
const Published published[] = {{1, 79.48, 80.88209408, 90.00369408, 1e-12},
                               {2, -209.88, 207486.72423501048, 2125570.342739224, 1e-12},
                               {3, -462.09, -383.06427743867573, -440.5552734899663, 1e-12},
                               {5, -9.21, 45.79, 24.79, 1e-12},
                               {6, 35.9, 228346.02149915518, 63279.64024377276, 1e-5},
                               {8, 149.15, 155.776101642076185, 223.032372285276267, 1e-12},
                               {9, 123.83, 130.32999999999998, 320.787855694743, 1e-5},
                               {10, -54.94, 3012725.1531188088, 1.5993611909160418e7, 1e-5},
                               {11, 76.27, 1.0191384843712414e7, 2.9635303873962525e7, 1e-5},
                               {12, -621.11, 2.5380326113958028e8, 1.0605291041185623e7, 1e-5},
                               {13, 29.97, 401.5200275285964, 322.16746069929945, 1e-5},
                               {14, -52.35, -50.86208518611569, -33.70140542917638, 1e-5},
                               {15, 1000.0, 1079.9262128908133, 1046.3248505990719, 1e-5},
                               {16, 71.35, 146.90148956646777, 100.61590510903495, 1e-3},
                               {17, -16.94, 23.800347975772173, 5.904389055594255, 1e-3},
                               {18, -16.94, 1258.5489743857706, 642.7620301505375, 1e-4},
                               {19, -102.55, -102.29962625728024, -100.25186697419281, 1e-4},
                               {20, -546.5, 4975.015399746393, -541.8410374659132, 1e-12},
                               {23, 6.87, 31.684643141172447, 69.88139433627418, 1e-3},
                               {24, 102.61, 142.06530570217677, 144.80265420862628, 1e-4}};

TEST(Bbob, PublishedValuesInTwoDimensions) {
  for (const Published& row : published) {
    const Function function(row.number, 2, 1);
    EXPECT_DOUBLE_EQ(function.optimum(), row.optimum) << row.number;
    EXPECT_NEAR(function({0.0, 0.0}), row.at_zero, row.tolerance * std::fabs(row.at_zero)) << row.number;
    EXPECT_NEAR(function({1.0, 2.0}), row.at_one_two, row.tolerance * std::fabs(row.at_one_two)) << row.number;
  }
}

// Values at the origin of twenty dimensions, instances 1 to 5, as published with the test data of IOHexperimenter.
TEST(Bbob, PublishedValuesInTwentyDimensions) {
  const std::map<int, std::vector<double>> rows{
      {1, {169.2528173, 541.1428819, -123.9430042, -42.3863648, 46.72402816}},
      {2, {11009229.19, 8959057.641, 11911047.56, 7208193.732, 20030631.74}},
      {3, {450.3301902, 1025.034336}},
      {7, {1849.514751, 2688.593133, 799.8196499, 1220.138697, 895.5198063}},
      {8, {26206.0431, 77337.29069, 83459.52154}},
      {22, {-917.1239745, 1083.679615, 33.69343011, 375.2760268, 133.1312146}},
      {23, {25.04093392, 9.784411099, -121.2228852, -201.0195667, -30.03813439}},
      {24, {415.7224616}}};
  for (const auto& [number, values] : rows) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Function function(number, 20, static_cast<int>(k) + 1);
      EXPECT_NEAR(function(std::vector<double>(20, 0.0)), values[k], 1e-9 * std::fabs(values[k]))
          << number << ", " << k + 1;
    }
  }
}

// The optimum is where it is said to be, nowhere lower, and in the box.
TEST(Bbob, TheOptimumIsTheLowest) {
  for (int number = 1; number <= function_count; ++number) {
    for (const std::size_t dimension : {2U, 5U}) {
      for (const int instance : {1, 7}) {
        const Function function(number, dimension, instance);
        const std::vector<double>& best = function.best();
        EXPECT_NEAR(function(best), function.optimum(), 1e-7) << number;
        const Stream stream = Stream(1).child("bbob").child(std::to_string(number));
        for (std::uint32_t draw = 0; draw < 200; ++draw) {
          std::vector<double> x;
          for (std::uint32_t k = 0; k < dimension; ++k) {
            EXPECT_LE(std::fabs(best[k]), half_side) << number;
            const double u = 2.0 * stream.uniform(draw, k) - 1.0;
            // Half of them close by.
            x.push_back(draw % 2 == 0 ? half_side * u : std::clamp(best[k] + 0.01 * u, -half_side, half_side));
          }
          EXPECT_GT(function(x), function.optimum() - 1e-7) << number;
        }
      }
    }
  }
}

TEST(Bbob, RefusesWhatIsNotAFunction) {
  EXPECT_THROW(Function(0, 2, 1), InputError);
  EXPECT_THROW(Function(25, 2, 1), InputError);
  EXPECT_THROW(Function(1, 1, 1), InputError);
  EXPECT_THROW(Function(1, 2, 0), InputError);
}

struct Row {
  std::size_t evaluations;
  double best, value;
};
std::vector<Row> rows_of(const std::string& text) {
  std::vector<Row> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("%")) continue;
    std::istringstream words(line);
    Row row{};
    std::size_t constraints = 1;
    EXPECT_TRUE(words >> row.evaluations >> constraints >> row.best >> row.value) << line;
    EXPECT_EQ(constraints, 0U);
    result.push_back(row);
  }
  return result;
}

TEST(BbobLog, HoldsTheRunAsItsFormatSays) {
  const Function function(1, 2, 1);
  Log log("test");
  log.begin(function);
  const Stream stream = Stream(5);
  std::vector<double> values;
  double best = 1e300;
  std::vector<double> bests;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const double width = std::pow(0.97, k);
    std::vector<double> x;
    for (std::uint32_t d = 0; d < 2; ++d) x.push_back(function.best()[d] + width * (2.0 * stream.uniform(k, d) - 1.0));
    values.push_back(function(x));
    best = std::min(best, values.back() - function.optimum());
    bests.push_back(best);
    log.evaluated(x, values.back());
  }
  log.end();
  const auto files = log.files();
  ASSERT_EQ(files.size(), 3U);
  const std::vector<Row> dat = rows_of(files.at("data_f1/bbobexp_f1_DIM2.dat"));
  const std::vector<Row> tdat = rows_of(files.at("data_f1/bbobexp_f1_DIM2.tdat"));
  for (const auto* rows : {&dat, &tdat}) {
    EXPECT_EQ(rows->back().evaluations, 300U);
    for (const Row& row : *rows) {
      EXPECT_NEAR(row.best, bests[row.evaluations - 1], 1e-9 * std::fabs(row.best));
      EXPECT_NEAR(row.value, values[row.evaluations - 1], 1e-8 * std::fabs(row.value));
    }
  }
  // From the rows of the .dat alone the best value is known to a hundredth of a decade at every evaluation, down to the
  // precision of 1e-8.
  std::size_t at = 0;
  for (std::size_t k = 0; k < bests.size(); ++k) {
    while (at + 1 < dat.size() && dat[at + 1].evaluations <= k + 1) ++at;
    EXPECT_LE(std::log10(std::max(dat[at].best, 1e-8) / std::max(bests[k], 1e-8)), 0.01 + 1e-6) << k;
  }
  for (const std::size_t moment : {1U, 2U, 4U, 10U, 20U, 40U, 100U, 200U}) {
    EXPECT_TRUE(std::ranges::any_of(tdat, [&](const Row& row) { return row.evaluations == moment; })) << moment;
  }
  const std::string& info = files.at("bbobexp_f1.info");
  EXPECT_NE(info.find("suite = 'bbob', funcId = 1, DIM = 2, "), std::string::npos);
  EXPECT_NE(info.find("data_f1/bbobexp_f1_DIM2.dat, 1:300|"), std::string::npos);
}

}  // namespace
}  // namespace hysteron::bbob
