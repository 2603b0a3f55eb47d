// What solvers make of a budget that holds few descents or generations.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/error.hpp"
#include "fit/driver.hpp"
#include "solver_harness.hpp"

namespace hysteron {
namespace {

// Rosenbrock's valley, so curved that no descent ends within a few points.
testing::Residuals curved(const double* u, std::size_t /*dimension*/) {
  const double x = 4.0 * u[0] - 2.0;
  const double y = 4.0 * u[1] - 2.0;
  return {{10.0 * (y - x * x), 1.0 - x, 0.1}, {-80.0 * x, 40.0, -4.0, 0.0, 0.0, 0.0}};
}

constexpr std::size_t dimension = 2;
constexpr std::size_t price = 1 + dimension;  // of a point, in evaluations
constexpr std::size_t held = 16;              // points of a descent

Problem problem_of(std::size_t budget) {
  Problem problem;
  problem.dimension = dimension;
  problem.budget = budget;
  problem.stream = Stream(3);
  problem.linear = {false, false};
  problem.start = {0.2, 0.5};
  problem.screening = true;
  return problem;
}

Request first_of(std::size_t budget) { return find_solver("multistart-lm")->make(problem_of(budget))->ask(); }

TEST(SmallBudget, HasNoMoreDescentsAtOnceThanItHoldsToTheirEnd) {
  const auto descents = [](std::size_t points) { return first_of(points * price).points.size() / dimension; };
  EXPECT_EQ(descents(5), 1U);
  EXPECT_EQ(descents(2 * held - 1), 1U);
  EXPECT_EQ(descents(2 * held), 2U);
  EXPECT_EQ(descents(4 * held - 1), 3U);
  EXPECT_EQ(descents(4 * held), 4U);
  EXPECT_EQ(descents(400 * held), 4U);
}

TEST(SmallBudget, ScreensWhereItHoldsAllDescents) {
  EXPECT_FALSE(first_of((4 * held - 1) * price).screening);
  EXPECT_TRUE(first_of(4 * held * price).screening);
}

TEST(SmallBudget, ShrinkingBoxHasNoMoreDescentsAStageThanItHoldsToTheirEnd) {
  constexpr std::size_t steps = 25;
  const auto descents = [](std::size_t points) {
    return find_solver("shrinking-box-lm")->make(problem_of(points * price))->ask().points.size() / dimension;
  };
  EXPECT_EQ(descents(5), 1U);
  EXPECT_EQ(descents(2 * steps), 2U);
  EXPECT_EQ(descents(400 * steps), 4U);
}

struct Population {
  const char* id;
  std::size_t at_100;
  std::size_t at_1000;
  std::size_t at_100000;
};

TEST(SmallBudget, APopulationHasTenGenerationsOrAsManyAsItsRuleSays) {
  for (const Population& expected : {Population{"crow-search", 5, 20, 20},
                                     {"grasshopper", 10, 30, 30},
                                     {"css", 10, 10, 10},
                                     {"adaptive-css", 10, 20, 20},
                                     {"pso-lm", 10, 24, 24},
                                     {"ga", 10, 50, 50},
                                     {"pso", 10, 10, 40},
                                     {"spso-2011", 10, 10, 40},
                                     {"shuffled-frog-leaping", 16, 40, 40}}) {
    const auto first = [&](std::size_t budget, double set) {
      Problem problem = problem_of(budget);
      const bool frogs = expected.id == std::string_view("shuffled-frog-leaping");
      problem.settings = {{frogs ? "memeplexes" : "population", set}};
      return find_solver(expected.id)->make(problem)->ask().points.size() / dimension;
    };
    EXPECT_EQ(first(100, 0.0), expected.at_100) << expected.id;
    EXPECT_EQ(first(1000, 0.0), expected.at_1000) << expected.id;
    EXPECT_EQ(first(100000, 0.0), expected.at_100000) << expected.id;
    EXPECT_EQ(first(0, 0.0), expected.at_100000) << expected.id;
    EXPECT_GT(first(100, 30.0), 20U) << expected.id;  // what is set holds
  }
  Problem problem = problem_of(100);
  problem.settings = {{"population", 1.0}};
  EXPECT_THROW(static_cast<void>(find_solver("crow-search")->make(problem)), InputError);
}

// A coordinate that the residual hardly depends on at the start asks for a step across the whole box.
testing::Residuals flat_at_first(const double* u, std::size_t /*dimension*/) {
  return {{u[0] * u[0] * u[0] - 0.5, u[1] - 0.5}, {3.0 * u[0] * u[0], 0.0, 0.0, 1.0}};
}

TEST(SmallBudget, IsNotSpentOnStepsAcrossTheBox) {
  Problem problem = problem_of(30 * price);
  problem.start = {0.05, 0.5};
  std::vector<double> asked;
  run_solver(*find_solver("lm"), problem, [&](const Request& request) {
    asked.push_back(request.points.front());
    return testing::evaluate(request, dimension, flat_at_first);
  });
  ASSERT_GT(asked.size(), 4U);
  double longest = 0.0;
  for (std::size_t k = 1; k < asked.size(); ++k) {
    longest = std::max(longest, std::fabs(asked[k] - asked[k - 1]));
  }
  EXPECT_LE(longest, 0.25 + 1e-12);
  EXPECT_GT(longest, 0.2) << "no step would have been longer";
}

TEST(SmallBudget, OfOneDescentIsThatFromTheStart) {
  const auto run = [](const char* id) {
    return run_solver(*find_solver(id), problem_of(10 * price),
                      [](const Request& request) { return testing::evaluate(request, dimension, curved); });
  };
  const RunResult one = run("lm");
  ASSERT_EQ(one.ended_by, EndedBy::budget);
  const RunResult many = run("multistart-lm");
  EXPECT_EQ(many.best, one.best);
  EXPECT_EQ(many.cost, one.cost);
}

}  // namespace
}  // namespace hysteron
