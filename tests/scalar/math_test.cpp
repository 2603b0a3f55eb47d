#include "scalar/math.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr int draws = 10000;
constexpr double ulp = 0x1p-52;

double between(const Stream& stream, int index, double lower, double upper, std::uint32_t which = 0) {
  return lower + (upper - lower) * stream.uniform(static_cast<std::uint64_t>(index), which);
}
double between_logarithmic(const Stream& stream, int index, double lower, double upper) {
  return std::exp(between(stream, index, std::log(lower), std::log(upper)));
}
std::uint64_t bits(double a) { return std::bit_cast<std::uint64_t>(a); }

TEST(Math, ExpIsWithinTwoUlp) {
  const Stream stream(1);
  for (int i = 0; i < draws; ++i) {
    const double a = i % 2 == 0 ? between(stream, i, -700.0, 700.0) : between(stream, i, -1.0, 1.0);
    EXPECT_NEAR(exp(a) / std::exp(a), 1.0, 2.0 * ulp) << a;
  }
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_TRUE(std::isfinite(exp(1e6)));
  EXPECT_GE(exp(-1e6), 0.0);
}

TEST(Math, LogIsWithinTwoUlp) {
  const Stream stream(2);
  for (int i = 0; i < draws; ++i) {
    const double a = i % 2 == 0 ? between_logarithmic(stream, i, 1e-299, 1e299) : between(stream, i, 0.5, 2.0);
    EXPECT_NEAR(log(a), std::log(a), 2.0 * ulp * std::fabs(std::log(a))) << a;
  }
  EXPECT_EQ(log(1.0), 0.0);
}

TEST(Math, PowErrorGrowsWithTheExponentOfTheResult) {
  const Stream stream(3);
  for (int i = 0; i < draws; ++i) {
    const double a = between_logarithmic(stream, i, 1e-30, 1e10);
    const double n = between(stream, i, 0.1, 8.0, 1);
    const double bound = 1e-15 * (1.0 + std::fabs(n * std::log(a)));
    EXPECT_NEAR(pow(a, n) / std::pow(a, n), 1.0, bound) << a << " ^ " << n;
  }
  EXPECT_EQ(pow(0.0, 1.5), 0.0);
}

TEST(Math, TanhIsWithinFiveUlp) {
  const Stream stream(4);
  for (int i = 0; i < draws; ++i) {
    const double size = between_logarithmic(stream, i, 1e-12, 50.0);
    const double a = i % 2 == 0 ? size : -size;
    EXPECT_NEAR(tanh(a) / std::tanh(a), 1.0, 5.0 * ulp) << a;
  }
  EXPECT_EQ(tanh(0.0), 0.0);
  EXPECT_EQ(tanh(1e9), 1.0);
}

TEST(Math, PowerLawIsExactAtOneAndTwo) {
  const Stream stream(5);
  for (int i = 0; i < draws; ++i) {
    const double a = between(stream, i, 0.0, 2.0);
    EXPECT_EQ(power_law(a, 1.0), a);
    EXPECT_EQ(power_law(a, 2.0), a * a);
    EXPECT_EQ(power_law(a, 1.5), pow(a, 1.5));
  }
}

// Every lane of a pack and the value of a dual have the bits of the double, for every function.
template <class F>
void expect_same_bits(const F& f, double lower, double upper, std::uint64_t seed) {
  const Stream stream(seed);
  for (int first = 0; first < draws; first += lane_count) {
    Lanes a;
    Lanes b;
    for (int k = 0; k < lane_count; ++k) {
      a.set_lane(k, between(stream, first + k, lower, upper));
      const int kind = (first + k) % 5;
      b.set_lane(k, kind == 0 ? 1.0 : kind == 1 ? 2.0 : between(stream, first + k, 0.2, 4.0, 1));
    }
    Dual<Lanes, 2> dual_a(a);
    Dual<Lanes, 2> dual_b(b);
    dual_a.d[0] = Lanes(1.0);
    dual_b.d[1] = Lanes(1.0);
    const Lanes packed = f(a, b);
    const Dual<Lanes, 2> differentiated = f(dual_a, dual_b);
    for (int k = 0; k < lane_count; ++k) {
      const double alone = f(a.lane(k), b.lane(k));
      EXPECT_EQ(bits(packed.lane(k)), bits(alone)) << a.lane(k) << " " << b.lane(k);
      EXPECT_EQ(bits(differentiated.v.lane(k)), bits(alone)) << a.lane(k) << " " << b.lane(k);
    }
  }
}

TEST(Math, PacksAndDualsRoundAsDoubles) {
  expect_same_bits([](const auto& a, const auto& b) { return exp(a + b); }, -800.0, 800.0, 11);
  expect_same_bits([](const auto& a, const auto& b) { return log(a) * b; }, 1e-3, 1e3, 12);
  expect_same_bits([](const auto& a, const auto& b) { return pow(abs(a), b); }, -3.0, 3.0, 13);
  expect_same_bits([](const auto& a, const auto& b) { return power_law(abs(a), b); }, -3.0, 3.0, 14);
  expect_same_bits([](const auto& a, const auto& b) { return tanh(a / b); }, -3.0, 3.0, 15);
  expect_same_bits([](const auto& a, const auto& b) { return sqrt(abs(a)) - b * sign(a); }, -3.0, 3.0, 16);
  expect_same_bits([](const auto& a, const auto& b) { return fma(min(a, b), max(a, b), select(a < b, a, b)); }, -3.0,
                   3.0, 17);
}

// Derivatives with respect to both arguments against central differences of the double.
template <class F>
void expect_derivatives(const F& f, double lower, double upper, std::uint64_t seed) {
  const Stream stream(seed);
  for (int i = 0; i < 500; ++i) {
    const double a = between(stream, i, lower, upper);
    const double b = between(stream, i, 1.2, 3.5, 1);
    Dual<double, 2> dual_a(a);
    Dual<double, 2> dual_b(b);
    dual_a.d[0] = 1.0;
    dual_b.d[1] = 1.0;
    const Dual<double, 2> result = f(dual_a, dual_b);
    const double step = 1e-6 * std::max(1.0, std::fabs(a));
    const double by_a = (f(a + step, b) - f(a - step, b)) / (2.0 * step);
    const double by_b = (f(a, b + 1e-6) - f(a, b - 1e-6)) / 2e-6;
    const double scale = 1.0 + std::fabs(f(a, b)) + std::fabs(by_a) + std::fabs(by_b);
    EXPECT_NEAR(result.d[0], by_a, 1e-7 * scale) << a << " " << b;
    EXPECT_NEAR(result.d[1], by_b, 1e-7 * scale) << a << " " << b;
  }
}

TEST(Dual, DerivativesMatchCentralDifferences) {
  expect_derivatives([](const auto& a, const auto& b) { return exp(a * b); }, -2.0, 2.0, 21);
  expect_derivatives([](const auto& a, const auto& b) { return log(a + b) / b; }, 0.1, 20.0, 22);
  expect_derivatives([](const auto& a, const auto& b) { return pow(a, b); }, 0.05, 3.0, 23);
  expect_derivatives([](const auto& a, const auto& b) { return power_law(a, b); }, 0.05, 3.0, 24);
  expect_derivatives([](const auto& a, const auto& b) { return tanh(a) * sqrt(b) - abs(a - b); }, -1.0, 1.0, 25);
  expect_derivatives([](const auto& a, const auto& b) { return max(a, b) * min(a, b); }, -1.0, 1.0, 26);
}

TEST(Dual, PowerLawAtOneAndTwoIsSmoothInTheExponent) {
  for (const double n : {1.0, 2.0}) {
    for (const double a : {0.2, 0.7, 1.0, 1.6}) {
      Dual<double, 2> base(a);
      Dual<double, 2> exponent(n);
      base.d[0] = 1.0;
      const Dual<double, 2> fixed = power_law(base, exponent);
      exponent.d[1] = 1.0;
      const Dual<double, 2> moving = power_law(base, exponent);
      EXPECT_EQ(fixed.v, moving.v);
      EXPECT_EQ(fixed.d[0], moving.d[0]);
      EXPECT_EQ(fixed.d[1], 0.0);
      EXPECT_NEAR(moving.d[0], n * std::pow(a, n - 1.0), 1e-14);
      EXPECT_NEAR(moving.d[1], std::pow(a, n) * std::log(a), 1e-14);
    }
  }
}

}  // namespace
}  // namespace hysteron
