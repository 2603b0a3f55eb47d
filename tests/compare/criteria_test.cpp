// Facts about residuals against the theory of the processes they are drawn from.
#include "compare/criteria.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.hpp"

namespace hysteron {
namespace {

// x_n = r x_(n-1) + e_n in its stationary state, variance 1.
std::vector<double> correlated(double r, std::size_t count, std::uint64_t seed) {
  const Stream stream(seed);
  std::vector<double> x;
  double last = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const double e = stream.normal(n);
    last = n == 0 ? e : r * last + std::sqrt(1.0 - r * r) * e;
    x.push_back(last);
  }
  return x;
}

TEST(Criteria, WhiteNoiseIsWhiteAndNormal) {
  const ResidualFacts facts = residual_facts(
      {correlated(0.0, 20000, 21), correlated(0.0, 20000, 22), correlated(0.0, 20000, 23), correlated(0.0, 20000, 24)});
  EXPECT_EQ(facts.samples, 80000U);
  EXPECT_NEAR(facts.mean_square, 1.0, 0.03);
  EXPECT_LE(facts.outside, 0.15);  // 6 of 40 where 2 are expected: one in a hundred draws has more
  EXPECT_NEAR(facts.autocorrelation[0], 0.0, 4.0 / std::sqrt(80000.0));  // four standard deviations
  const double width = 2.0 * histogram_reach / histogram_bins;
  EXPECT_NEAR(std::accumulate(facts.histogram.begin(), facts.histogram.end(), 0.0) * width + facts.beyond, 1.0, 1e-9);
  EXPECT_NEAR(facts.histogram[histogram_bins / 2], 0.3989, 0.02);
}

// One recording whose noise is twenty times that of the others: it alone makes the sum.
TEST(Criteria, WhiteNoiseOfUnequalSizesIsWhite) {
  double outside = 0.0;
  constexpr int draws = 50;
  for (int k = 0; k < draws; ++k) {
    std::vector<std::vector<double>> residuals;
    for (int r = 0; r < 5; ++r) {
      residuals.push_back(correlated(0.0, 1500, 700 + static_cast<std::uint64_t>(5 * k + r)));
    }
    for (double& value : residuals[0]) {
      value *= 20.0;
    }
    outside += residual_facts(residuals).outside / draws;
  }
  EXPECT_NEAR(outside, 0.05, 0.02);  // four standard deviations of the mean share of 2,000 lags
  EXPECT_NEAR(residual_facts({correlated(0.0, 900, 1)}).white_band, 1.96 / 30.0, 1e-12);
}

TEST(Criteria, AutocorrelationIsThatOfTheProcess) {
  const ResidualFacts facts = residual_facts({correlated(0.8, 200000, 3)});
  for (std::size_t lag = 1; lag <= 6; ++lag) {
    EXPECT_NEAR(facts.autocorrelation[lag - 1], std::pow(0.8, static_cast<double>(lag)), 0.02) << lag;
  }
  EXPECT_GT(facts.outside, 0.2);
}

// What the effective sample size means: the variance of a mean of n correlated samples is 1 / n_eff.
TEST(Criteria, EffectiveSamplesGiveTheVarianceOfAMean) {
  constexpr std::size_t length = 400;
  constexpr double r = 0.7;
  double square = 0.0;
  constexpr int draws = 2000;
  for (int k = 0; k < draws; ++k) {
    const std::vector<double> x = correlated(r, length, 100 + static_cast<std::uint64_t>(k));
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(length);
    square += mean * mean / draws;
  }
  ResidualFacts facts;
  facts.samples = length;
  facts.autocorrelation = {r};
  EXPECT_NEAR(square * facts.effective_samples(), 1.0, 0.1);
}

TEST(Criteria, ByHand) {
  const Criteria c = criteria(0.25, 100.0, 3);
  EXPECT_NEAR(c.aic, 100.0 * std::log(0.25) + 6.0, 1e-12);
  EXPECT_NEAR(c.bic, 100.0 * std::log(0.25) + 3.0 * std::log(100.0), 1e-12);
}

TEST(Criteria, AnExactModelHasNoCorrelations) {
  const ResidualFacts facts = residual_facts({std::vector<double>(100, 0.0)});
  EXPECT_EQ(facts.mean_square, 0.0);
  EXPECT_EQ(facts.outside, 0.0);
  EXPECT_TRUE(std::isfinite(criteria(facts.mean_square, facts.effective_samples(), 2).bic));
}

}  // namespace
}  // namespace hysteron
