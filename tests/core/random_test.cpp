// Random streams: the generator's published answer, moments, independence, addressing; and word suggestions.
#include "core/random.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/suggest.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t seed = 20211;
constexpr std::size_t draws = 200000;

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments(const std::vector<double>& values) {
  Moments result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  for (const double value : values) {
    result.variance += (value - result.mean) * (value - result.mean) / static_cast<double>(values.size());
  }
  return result;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments ma = moments(a);
  const Moments mb = moments(b);
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - ma.mean) * (b[n] - mb.mean);
  return sum / static_cast<double>(a.size()) / std::sqrt(ma.variance * mb.variance);
}

std::vector<double> uniforms(const Stream& stream, std::size_t count = draws) {
  std::vector<double> result;
  for (std::size_t n = 0; n < count; ++n) result.push_back(stream.uniform(n));
  return result;
}

// Kolmogorov-Smirnov distance of a sample from the uniform distribution, times sqrt(n).
double distance_from_uniform(std::vector<double> values) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  double worst = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    worst = std::max({worst, std::fabs(values[n] - static_cast<double>(n) / count),
                      std::fabs(values[n] - static_cast<double>(n + 1) / count)});
  }
  return worst * std::sqrt(count);
}

// kat_vectors of Random123: philox4x32 10.
TEST(Philox, GivesThePublishedAnswers) {
  r123::Philox4x32 generator;
  const std::array<std::uint32_t, 4> zero{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8};
  const std::array<std::uint32_t, 4> ones{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd};
  const std::uint32_t all = 0xffffffff;
  const auto from_zero = generator(r123::Philox4x32::ctr_type{{0, 0, 0, 0}}, r123::Philox4x32::key_type{{0, 0}});
  const auto from_ones =
      generator(r123::Philox4x32::ctr_type{{all, all, all, all}}, r123::Philox4x32::key_type{{all, all}});
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(from_zero[k], zero[k]) << "word " << k;
    EXPECT_EQ(from_ones[k], ones[k]) << "word " << k;
  }
}

TEST(Stream, IsPhiloxAtCounterZeroAndKeyZero) {
  const std::uint64_t word = 0xe169c58d6627e8d5ULL;
  EXPECT_EQ(Stream(0).uniform(0), (static_cast<double>(word >> 12U) + 0.5) * 0x1.0p-52);
}

TEST(Stream, UniformHasTheMomentsAndShapeOfTheUniformDistribution) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<double> values = uniforms(Stream(seed));
  const Moments of = moments(values);
  const auto count = static_cast<double>(draws);
  EXPECT_NEAR(of.mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_NEAR(of.variance, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / count));
  EXPECT_LT(distance_from_uniform(values), 1.95);  // exceeded once in a thousand seeds
  for (const double value : values) {
    ASSERT_GT(value, 0.0);
    ASSERT_LT(value, 1.0);
  }
}

TEST(Stream, NormalHasTheMomentsAndShapeOfTheNormalDistribution) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Stream stream(seed);
  std::vector<double> values;
  std::vector<double> through_distribution;
  double fourth = 0.0;
  for (std::size_t n = 0; n < draws; ++n) {
    values.push_back(stream.normal(n));
    through_distribution.push_back(0.5 * std::erfc(-values.back() / std::sqrt(2.0)));
    fourth += std::pow(values.back(), 4) / static_cast<double>(draws);
  }
  const Moments of = moments(values);
  const auto count = static_cast<double>(draws);
  EXPECT_NEAR(of.mean, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(of.variance, 1.0, 4.0 * std::sqrt(2.0 / count));
  EXPECT_NEAR(fourth, 3.0, 4.0 * std::sqrt(96.0 / count));
  EXPECT_LT(distance_from_uniform(through_distribution), 1.95);
}

TEST(Stream, BelowIsEvenOverItsValuesAndStaysBelow) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Stream stream(seed);
  constexpr std::size_t sides = 7;
  std::array<double, sides> count{};
  for (std::size_t n = 0; n < draws; ++n) {
    const auto value = stream.below(sides, n, 3, 5);
    ASSERT_LT(value, sides);
    ++count.at(value);
  }
  const double expected = static_cast<double>(draws) / sides;
  double chi_squared = 0.0;
  for (const double seen : count) chi_squared += (seen - expected) * (seen - expected) / expected;
  EXPECT_LT(chi_squared, 22.5);  // 6 degrees of freedom, p = 0.001
  EXPECT_EQ(stream.below(1, 17), 0U);
}

TEST(Stream, ChildrenAreUncorrelatedWithParentSiblingsAndShiftedSelves) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Stream parent(seed);
  const std::vector<std::vector<double>> series{uniforms(parent),
                                                uniforms(parent.child("pso")),
                                                uniforms(parent.child("psp")),
                                                uniforms(parent.child(std::uint64_t{0})),
                                                uniforms(parent.child(std::uint64_t{1})),
                                                uniforms(Stream(seed + 1)),
                                                uniforms(parent.child("pso").child(std::uint64_t{0}))};
  const double limit = 4.5 / std::sqrt(static_cast<double>(draws));
  for (std::size_t a = 0; a < series.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_LT(std::fabs(correlation(series[a], series[b])), limit) << "series " << a << " and " << b;
    }
    const std::vector<double> early(series[a].begin(), series[a].end() - 1);
    const std::vector<double> late(series[a].begin() + 1, series[a].end());
    EXPECT_LT(std::fabs(correlation(early, late)), limit) << "series " << a << " with itself one later";
  }
}

TEST(Stream, ChildrenOfManyLabelsAndIndicesAreAllDifferent) {
  const Stream parent(seed);
  std::set<double> first;
  std::size_t made = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    first.insert(parent.child(k).uniform(0));
    first.insert(parent.child(std::to_string(k)).uniform(0));
    made += 2;
  }
  first.insert(parent.child("").uniform(0));
  first.insert(parent.uniform(0));
  first.insert(parent.child("a").child("b").uniform(0));
  first.insert(parent.child("b").child("a").uniform(0));
  first.insert(parent.child("ab").uniform(0));
  EXPECT_EQ(first.size(), made + 5);
}

TEST(Stream, ADrawIsAPureFunctionOfItsAddress) {
  const Stream stream = Stream(seed).child("de").child(std::uint64_t{4});
  const double before = stream.uniform(3, 2, 1);
  const double normal_before = stream.normal(3, 2, 1);
  for (std::uint64_t n = 0; n < 1000; ++n) static_cast<void>(stream.uniform(n) + stream.normal(n, 1));
  const Stream again = Stream(seed).child("de").child(std::uint64_t{4});
  EXPECT_EQ(stream.uniform(3, 2, 1), before);
  EXPECT_EQ(again.uniform(3, 2, 1), before);
  EXPECT_EQ(again.normal(3, 2, 1), normal_before);
  // Every part of the address counts, the high half of the first too.
  const std::set<double> others{before,
                                stream.uniform(2, 2, 1),
                                stream.uniform(3, 3, 1),
                                stream.uniform(3, 2, 2),
                                stream.uniform(3, 1, 2),
                                stream.uniform(2, 3, 1),
                                stream.uniform(3 + (std::uint64_t{1} << 32U), 2, 1)};
  EXPECT_EQ(others.size(), 7U);
}

TEST(Suggestion, NamesTheNearestKnownWord) {
  const std::vector<std::string> known{"bouc-wen", "modified-bouc-wen", "bingham", "lugre"};
  EXPECT_EQ(suggestion("bouc-wem", known), " (did you mean 'bouc-wen'?)");
  EXPECT_EQ(suggestion("boucwen", known), " (did you mean 'bouc-wen'?)");
  EXPECT_EQ(suggestion("bingam", known), " (did you mean 'bingham'?)");
  EXPECT_EQ(suggestion("lugre", known), " (did you mean 'lugre'?)");
  EXPECT_EQ(suggestion("fti", {"list", "fit"}), " (did you mean 'fit'?)");
}

TEST(Suggestion, IsEmptyWhenNothingIsNear) {
  EXPECT_EQ(suggestion("zzzzzzzz", {"bouc-wen", "bingham"}), "");
  EXPECT_EQ(suggestion("anything", {}), "");
  EXPECT_EQ(suggestion("", {"bouc-wen"}), "");
}

TEST(Suggestion, TakesTheFirstOfEquallyNearWords) {
  EXPECT_EQ(suggestion("k9", {"k0", "k1"}), " (did you mean 'k0'?)");
}

}  // namespace
}  // namespace hysteron
