// What theory says of solvers apart from their rates: methods that only compare costs do not see how costs are scaled,
// CMA-ES does not see a rotation, a single descent ends in the basin it starts in, and methods with restarts or
// populations leave local minima.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "fit/solver.hpp"
#include "tests/algorithms/solver_harness.hpp"

namespace hysteron {
namespace {

testing::Run run_of(std::string_view id, const testing::Objective& objective, std::size_t dimension, std::size_t budget,
                    std::uint64_t seed) {
  Problem problem;
  problem.dimension = dimension;
  problem.budget = budget;
  problem.stream = Stream(seed).child("invariance");
  problem.linear.assign(dimension, false);
  return testing::drive(*find_solver(id), problem, objective);
}

// Ten to the power of the cost in place of the cost: the same order, another shape.
testing::Residuals exaggerated(const double* u, std::size_t n) {
  const testing::Residuals inside = testing::rosenbrock(u, n);
  double squares = 0.0;
  for (const double r : inside.value) squares += r * r;
  return {{std::exp(0.3 * std::sqrt(squares))}, {}};
}
testing::Residuals plain(const double* u, std::size_t n) {
  testing::Residuals inside = testing::rosenbrock(u, n);
  return {inside.value, {}};
}

TEST(Invariance, MethodsThatCompareDoNotSeeTheScaleOfTheCost) {
  for (const char* id : {"random-search", "pso", "spso-2011", "cma-es", "nelder-mead", "pattern-search", "crow-search",
                         "shuffled-frog-leaping", "aco-r"}) {
    const testing::Run one = run_of(id, plain, 3, 600, 1);
    const testing::Run other = run_of(id, exaggerated, 3, 600, 1);
    ASSERT_EQ(one.exchanges.size(), other.exchanges.size()) << id;
    for (std::size_t k = 0; k < one.exchanges.size(); ++k) {
      ASSERT_EQ(one.exchanges[k].request.points, other.exchanges[k].request.points) << id << ", request " << k;
    }
  }
}

// Methods that weigh points by their cost do see it, so that the test above can fail.
TEST(Invariance, MethodsThatWeighDoSeeIt) {
  for (const char* id : {"css", "de"}) {
    const testing::Run one = run_of(id, plain, 3, 600, 1);
    const testing::Run other = run_of(id, exaggerated, 3, 600, 1);
    bool same = one.exchanges.size() == other.exchanges.size();
    for (std::size_t k = 0; same && k < one.exchanges.size(); ++k) {
      same = one.exchanges[k].request.points == other.exchanges[k].request.points;
    }
    EXPECT_FALSE(same) << id;
  }
}

// Ellipsoid of condition 1e4 about the middle of the box, along the axes or along the Householder reflection of the
// diagonal, which keeps volumes and turns every axis.
template <bool turned>
testing::Residuals stretched(const double* u, std::size_t n) {
  std::vector<double> x(n);
  double sum = 0.0;
  for (std::size_t d = 0; d < n; ++d) {
    x[d] = u[d] - 0.5 - 0.02 * static_cast<double>(d);
    sum += x[d] * (turned ? static_cast<double>(d + 1) : 0.0);
  }
  double norm = 0.0;
  for (std::size_t d = 0; d < n; ++d) norm += static_cast<double>((d + 1) * (d + 1));
  testing::Residuals out{std::vector<double>(n), {}};
  for (std::size_t d = 0; d < n; ++d) {
    const double along = turned ? x[d] - 2.0 * sum * static_cast<double>(d + 1) / norm : x[d];
    out.value[d] = std::pow(100.0, static_cast<double>(d) / static_cast<double>(n - 1)) * along;
  }
  return out;
}

double median_evaluations(std::string_view id, const testing::Objective& objective, std::size_t dimension) {
  std::vector<double> used;
  for (std::uint64_t seed = 1; seed <= 11; ++seed) {
    Problem problem;
    problem.dimension = dimension;
    problem.budget = 20000;
    problem.stream = Stream(seed).child("invariance");
    problem.linear.assign(dimension, false);
    const testing::Run run = testing::drive(*find_solver(id), problem, objective, {}, 1e-6);
    used.push_back(run.used_at_target > 0 ? static_cast<double>(run.used_at_target) : 1e9);
  }
  std::ranges::sort(used);
  return used[5];
}

TEST(Invariance, CmaEsDoesNotSeeARotation) {
  const double along = median_evaluations("cma-es", stretched<false>, 5);
  const double across = median_evaluations("cma-es", stretched<true>, 5);
  EXPECT_LT(along, 1e9);
  EXPECT_NEAR(across / along, 1.0, 0.15);
}

// Two wells along the first coordinate, at x = -1 and, lower, at x = 1; x from -3 to 1.5. The other coordinate is
// plain.
//   r = (x^2 - 1, 0.3 (x - 1), y)
testing::Residuals two_wells(const double* u, std::size_t n) {
  const double x = -3.0 + 4.5 * u[0];
  const double y = u[1] - 0.4;
  testing::Residuals out{{x * x - 1.0, 0.3 * (x - 1.0), y}, std::vector<double>(3 * n, 0.0)};
  out.jacobian[0] = 2.0 * x * 4.5;
  out.jacobian[n] = 0.3 * 4.5;
  out.jacobian[2 * n + 1] = 1.0;
  return out;
}

TEST(LocalMinima, OneDescentEndsInTheBasinItStartsIn) {
  // The lower well has about a third of the box. Of 60 random starts 11 to 31 end there with 99.9 % where that third is
  // between 0.28 and 0.42, which the long steps of Gauss and Newton near the ridge leave open.
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Problem problem;
    problem.dimension = 2;
    problem.budget = 600;
    problem.stream = Stream(seed).child("wells");
    problem.linear.assign(2, false);
    const Stream draw = problem.stream.child("start");
    problem.start = {draw.uniform(0), draw.uniform(1)};
    found += testing::drive(*find_solver("lm"), problem, two_wells).best < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(found, 8);
  EXPECT_LE(found, 36);
}

TEST(LocalMinima, ManyDescentsFindTheLowerWell) {
  for (const char* id : {"multistart-lm", "pso-lm"}) {
    for (std::uint64_t seed = 1; seed <= 11; ++seed) {
      EXPECT_LT(run_of(id, two_wells, 2, 2000, seed).best, 1e-3) << id << ", seed " << seed;
    }
  }
  // The shrinking box draws three starts in the whole box and then looks around the best alone: it finds the well where
  // one of the three has met it, 1 - (2/3)^3 = 0.70 where its third is exact. 24 to 56 of 60 with 99.9 % for 0.6 to
  // 0.8.
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    found += run_of("shrinking-box-lm", two_wells, 2, 2000, seed).best < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(found, 24);
  EXPECT_LE(found, 56);
}

// Rastrigin on [-2.5, 2.5]^2: 25 wells of one shape, the lowest off the middle. sum x^2 - 10 cos(2 pi x) + 10 as a sum
// of squares; without derivatives.
testing::Residuals rastrigin(const double* u, std::size_t n) {
  testing::Residuals out;
  for (std::size_t d = 0; d < n; ++d) {
    const double x = 5.0 * (u[d] - testing::optimum_coordinate(d));
    out.value.push_back(std::sqrt(std::max(0.0, x * x - 10.0 * std::cos(2.0 * std::numbers::pi * x) + 10.0)));
  }
  return out;
}

TEST(LocalMinima, GlobalMethodsLeaveTheWellsOfRastrigin) {
  // A well next to the lowest has a cost of 1. One descent ends in the lowest well of the 25 with 1/25 = 0.04: four
  // times or more of eleven with less than 0.001.
  for (const char* id : {"pso", "spso-2011", "ga", "de", "cma-es", "css", "adaptive-css", "shuffled-frog-leaping",
                         "aco-r", "crow-search", "ga-pattern-search", "nelder-mead", "pattern-search"}) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 11; ++seed) {
      found += run_of(id, rastrigin, 2, 4000, seed).best < 0.5 ? 1 : 0;
    }
    EXPECT_GE(found, 4) << id;
  }
}

}  // namespace
}  // namespace hysteron
