// Where the starts of a solver ended: a cost with two valleys of known depths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/driver.hpp"
#include "solver_harness.hpp"

namespace hysteron {
namespace {

// cost^2 = (2 + cos a)^2 + (u/2)^2 with a = pi/2 + 3 pi u: valleys at u = 1/6 and 5/6, where the first part is 1; at
// both ends of the box the cost falls inwards.
testing::Residuals valleys(const double* u, std::size_t /*dimension*/) {
  const double angle = 0.5 * std::numbers::pi + 3.0 * std::numbers::pi * u[0];
  return {{2.0 + std::cos(angle), 0.5 * u[0]}, {-3.0 * std::numbers::pi * std::sin(angle), 0.5}};
}

RunResult run(const std::string& id, std::size_t budget) {
  Problem problem;
  problem.dimension = 1;
  problem.budget = budget;
  problem.stream = Stream(7);
  problem.linear = {false};
  return run_solver(*find_solver(id), problem,
                    [](const Request& request) { return testing::evaluate(request, 1, valleys); });
}

class EndsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(EndsOf, AreTheFloorsOfTheValleys) {
  const RunResult result = run(GetParam(), 4000);
  ASSERT_GE(result.ends.cost.size(), 8U);
  EXPECT_FALSE(result.ends.screened);
  EXPECT_EQ(result.ends.diverged, 0U);
  const double low = std::hypot(1.0, 1.0 / 12.0);
  const double high = std::hypot(1.0, 5.0 / 12.0);
  std::size_t in_low = 0;
  for (const double cost : result.ends.cost) {
    // Both floors lie a little beside the cosine's, by the slope of the second part.
    const bool best = std::fabs(cost - low) < 2e-3;
    in_low += best ? 1 : 0;
    EXPECT_TRUE(best || std::fabs(cost - high) < 2e-3) << cost;
    EXPECT_GE(cost, result.cost);
  }
  EXPECT_GT(in_low, 0U);
  EXPECT_LT(in_low, result.ends.cost.size());
}

INSTANTIATE_TEST_SUITE_P(Starting, EndsOf, ::testing::Values("multistart-lm", "nelder-mead", "pattern-search"),
                         [](const auto& instance) {
                           std::string name(instance.param);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Ends, ASolverThatStartsOnceHasNone) { EXPECT_TRUE(run("pso", 400).ends.cost.empty()); }

}  // namespace
}  // namespace hysteron
