// Statistics against published examples and values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "study/proportion.hpp"
#include "study/quantile.hpp"
#include "study/ranks.hpp"
#include "study/runtime.hpp"

namespace hysteron {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  const Quartiles q = quartiles({1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  EXPECT_DOUBLE_EQ(q.lower, 2.25);
  EXPECT_DOUBLE_EQ(q.median, 3.5);
  EXPECT_DOUBLE_EQ(q.upper, 4.75);
}

TEST(Quantile, KeepsInfiniteCostsApart) {
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0, infinite}, 0.5), 2.0);
  EXPECT_EQ(quantile({1.0, infinite}, 0.5), infinite);
  EXPECT_EQ(quantile({infinite, infinite}, 0.25), infinite);
}

// Newcombe, Stat. Med. 17 (1998) 857-872, table I, method 3.
TEST(Wilson, MatchesPublishedIntervals) {
  const Interval a = wilson(81, 263);
  EXPECT_NEAR(a.lower, 0.2553, 5e-5);
  EXPECT_NEAR(a.upper, 0.3662, 5e-5);
  const Interval b = wilson(15, 148);
  EXPECT_NEAR(b.lower, 0.0624, 5e-5);
  EXPECT_NEAR(b.upper, 0.1605, 5e-5);
  const Interval c = wilson(0, 20);
  EXPECT_DOUBLE_EQ(c.lower, 0.0);
  EXPECT_NEAR(c.upper, 0.1611, 5e-5);
  const Interval d = wilson(1, 29);
  EXPECT_NEAR(d.lower, 0.0061, 5e-5);
  EXPECT_NEAR(d.upper, 0.1718, 5e-5);
}

TEST(Ranks, ShareThemselvesBetweenEqualValues) {
  EXPECT_EQ(midranks({3.0, 1.0, 3.0, 2.0}), (std::vector<double>{3.5, 1.0, 3.5, 2.0}));
  EXPECT_EQ(midranks({1.0, 1.0005, 1.002}, 1e-3), (std::vector<double>{1.5, 1.5, 3.0}));
  EXPECT_EQ(midranks({infinite, 1.0, infinite}), (std::vector<double>{2.5, 1.0, 2.5}));
}

// Hollander and Wolfe 1973, p. 29: depression scale factor of nine patients. V = 40, two-sided p = 20/512.
TEST(Wilcoxon, MatchesHollanderAndWolfe) {
  const std::vector<double> x{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> y{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> d;
  for (std::size_t k = 0; k < x.size(); ++k) d.push_back(x[k] - y[k]);
  const SignedRank test = signed_rank_test(d);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(test.w_plus, 40.0);
  EXPECT_DOUBLE_EQ(test.p, 20.0 / 512.0);
}

TEST(Wilcoxon, CountsTiesAndHandlesMidranks) {
  // Differences 1, 1, 2: ranks 1.5, 1.5, 3. All signs equal: 2 of 8 sign patterns are as extreme.
  const SignedRank test = signed_rank_test({1.0, 1.0, 2.0, 0.0, 1e-9}, 1e-6);
  EXPECT_EQ(test.pairs, 5U);
  EXPECT_EQ(test.zeros, 2U);
  EXPECT_DOUBLE_EQ(test.w_plus, 6.0);
  EXPECT_DOUBLE_EQ(test.p, 0.25);
  // -1, 1, 2: W+ is 1.5 + 3 = 4.5, W- 1.5. Subsets with a rank sum <= 1.5: {}, {1.5}, {1.5'}: 3 of 8, twice.
  EXPECT_DOUBLE_EQ(signed_rank_test({-1.0, 1.0, 2.0}).p, 0.75);
  EXPECT_DOUBLE_EQ(signed_rank_test({0.0, 0.0}).p, 1.0);
}

TEST(Wilcoxon, ApproximationAgreesWithTheExactDistribution) {
  // 50 differences are exact, 51 approximated; the p of nearly the same sample must agree.
  std::vector<double> d;
  for (int k = 1; k <= 50; ++k) d.push_back((k % 3 == 0 ? -1.0 : 1.0) * k);
  const SignedRank exact = signed_rank_test(d);
  ASSERT_TRUE(exact.exact);
  // Edgeworth by hand: W+ = sum i B_i with fourth cumulant -sum i^4 / 8, mean n(n+1)/4, variance n(n+1)(2n+1)/24.
  double fourth = 0.0;
  for (int k = 1; k <= 50; ++k) fourth -= std::pow(k, 4.0) / 8.0;
  const double variance = 50.0 * 51.0 * 101.0 / 24.0;
  const double z = (std::fabs(exact.w_plus - 637.5) - 0.5) / std::sqrt(variance);
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  const double tail = normal_tail(z) + fourth / (variance * variance) / 24.0 * (z * z * z - 3.0 * z) * density;
  EXPECT_NEAR(exact.p, 2.0 * tail, 1e-4);
  d.push_back(51.0);
  EXPECT_FALSE(signed_rank_test(d).exact);
}

TEST(Wilcoxon, NeedsSoManyPairsToShowAnything) {
  for (const std::size_t tests : {std::size_t{1}, std::size_t{3}, std::size_t{30}}) {
    const std::size_t pairs = pairs_to_tell(tests, 0.05);
    const auto least = [&](std::size_t count) {
      return static_cast<double>(tests) * signed_rank_test(std::vector<double>(count, 1.0)).p;
    };
    EXPECT_LT(least(pairs), 0.05);
    EXPECT_GE(least(pairs - 1), 0.05);
  }
  EXPECT_EQ(pairs_to_tell(1, 0.05), 6U);
}

TEST(Holm, StepsDownAndStaysMonotone) {
  const std::vector<double> adjusted = holm({0.01, 0.04, 0.03, 0.005});
  EXPECT_DOUBLE_EQ(adjusted[3], 0.02);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
  EXPECT_DOUBLE_EQ(holm({0.9, 0.8})[0], 1.0);
}

// Hollander and Wolfe 1973, p. 140: rounding first base. Chi-squared 11.143 with ties, p 0.003805.
TEST(Friedman, MatchesHollanderAndWolfe) {
  const std::vector<std::vector<double>> times{
      {5.40, 5.50, 5.55}, {5.85, 5.70, 5.75}, {5.20, 5.60, 5.50}, {5.55, 5.50, 5.40}, {5.90, 5.85, 5.70},
      {5.45, 5.55, 5.60}, {5.40, 5.40, 5.35}, {5.45, 5.50, 5.35}, {5.25, 5.15, 5.00}, {5.85, 5.80, 5.70},
      {5.25, 5.20, 5.10}, {5.65, 5.55, 5.45}, {5.60, 5.35, 5.45}, {5.05, 5.00, 4.95}, {5.50, 5.50, 5.40},
      {5.45, 5.55, 5.50}, {5.55, 5.55, 5.35}, {5.45, 5.50, 5.55}, {5.50, 5.45, 5.25}, {5.65, 5.60, 5.40},
      {5.70, 5.65, 5.55}, {6.30, 6.30, 6.25}};
  const Friedman test = friedman_test(times);
  EXPECT_NEAR(test.chi_squared, 11.1429, 5e-5);
  EXPECT_NEAR(test.p, 0.003805, 5e-7);
}

// Demsar, J. Mach. Learn. Res. 7 (2006) 1-30, table 5: q of the Nemenyi test at 5 %; 4 algorithms on 14 sets: CD 1.25.
TEST(Nemenyi, MatchesDemsar) {
  EXPECT_NEAR(nemenyi_quantile(2), 1.960, 5e-4);
  EXPECT_NEAR(nemenyi_quantile(3), 2.343, 1.1e-3);
  EXPECT_NEAR(nemenyi_quantile(4), 2.569, 5e-4);
  EXPECT_NEAR(nemenyi_quantile(5), 2.728, 5e-4);
  EXPECT_NEAR(nemenyi_quantile(10), 3.164, 5e-4);
  const std::vector<std::vector<double>> blocks(14, {1.0, 2.0, 3.0, 4.0});
  EXPECT_NEAR(friedman_test(blocks).critical_difference, 1.25, 5e-3);
}

TEST(Friedman, OfEqualCostsShowsNothing) {
  const Friedman test = friedman_test({{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}});
  EXPECT_DOUBLE_EQ(test.chi_squared, 0.0);
  EXPECT_DOUBLE_EQ(test.p, 1.0);
}

TEST(Cliques, AreMaximalAndWithoutRepeats) {
  const auto groups = cliques({1.0, 1.5, 2.4, 4.0, 4.1}, 1.0);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0], (std::pair<std::size_t, std::size_t>{0, 1}));
  EXPECT_EQ(groups[1], (std::pair<std::size_t, std::size_t>{1, 2}));
  EXPECT_EQ(groups[2], (std::pair<std::size_t, std::size_t>{3, 4}));
}

TEST(ChiSquared, TailMatchesTables) {
  EXPECT_NEAR(chi_squared_tail(3.841458821, 1.0), 0.05, 1e-9);
  EXPECT_NEAR(chi_squared_tail(9.487729037, 4.0), 0.05, 1e-9);
  EXPECT_NEAR(chi_squared_tail(2.0, 2.0), std::exp(-1.0), 1e-14);
  EXPECT_NEAR(chi_squared_tail(40.0, 2.0), std::exp(-20.0), 1e-20);
}

TEST(ExpectedRunTime, CountsFailuresToo) {
  const std::vector<Attempt> attempts{{true, 100.0}, {false, 1000.0}, {true, 300.0}, {false, 1000.0}};
  const ExpectedRunTime time = expected_run_time(attempts, Stream(1));
  EXPECT_DOUBLE_EQ(time.value.value(), 1200.0);
  EXPECT_EQ(time.successes, 2U);
  EXPECT_LE(time.interval->lower, 1200.0);
  EXPECT_GE(time.interval->upper, 1200.0);
  // Four runs with two failures: a resample without success has probability 1/16 > 2.5 %.
  EXPECT_EQ(time.interval->upper, infinite);
  const ExpectedRunTime never = expected_run_time({{false, 500.0}, {false, 700.0}}, Stream(1));
  EXPECT_FALSE(never.value.has_value());
  EXPECT_DOUBLE_EQ(never.spent, 1200.0);
}

TEST(ExpectedRunTime, IntervalOfEqualRunsIsAPoint) {
  const ExpectedRunTime time = expected_run_time({{true, 50.0}, {true, 50.0}, {true, 50.0}}, Stream(3));
  EXPECT_DOUBLE_EQ(time.interval->lower, 50.0);
  EXPECT_DOUBLE_EQ(time.interval->upper, 50.0);
}

TEST(PerformanceProfile, ByHand) {
  // Two solvers, three problems: a wins 1 (ratio of b 2), b wins 2 (ratio of a 4), nobody solves 3.
  const auto profile = performance_profile({{10.0, 20.0}, {40.0, 10.0}, {infinite, infinite}}, {1.0, 2.0, 4.0});
  EXPECT_EQ(profile[0], (std::vector<double>{1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0}));
  EXPECT_EQ(profile[1], (std::vector<double>{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}));
}

TEST(DataProfile, ByHand) {
  // Dimensions 1 and 4: 10 evaluations are 5 and 2 units.
  const auto profile = data_profile({{10.0, infinite}, {10.0, 50.0}}, {1, 4}, {2.0, 5.0, 10.0});
  EXPECT_EQ(profile[0], (std::vector<double>{0.5, 1.0, 1.0}));
  EXPECT_EQ(profile[1], (std::vector<double>{0.0, 0.0, 0.5}));
}

}  // namespace
}  // namespace hysteron
