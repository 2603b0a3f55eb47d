// Algorithms of other libraries behind ask and tell: all of them run, are cut off anywhere and let go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "fit/solver.hpp"
#include "tests/algorithms/solver_harness.hpp"

namespace hysteron {
namespace {

// As of one recording, so that costs are known to be roots of sums of squares.
Problem problem_of(std::size_t dimension, std::size_t budget, std::uint64_t seed = 1) {
  Problem problem;
  problem.recordings = {1};
  problem.dimension = dimension;
  problem.budget = budget;
  problem.stream = Stream(seed).child("foreign");
  problem.linear.assign(dimension, false);
  return problem;
}

std::vector<const SolverEntry*> foreign() {
  std::vector<const SolverEntry*> result;
  for (const SolverEntry* entry : solver_catalogue()) {
    if (entry->id.find(':') != std::string_view::npos) result.push_back(entry);
  }
  return result;
}

TEST(Foreign, FamiliesAreFoundAndTheirMembersListed) {
  ASSERT_NE(find_solver_family("nlopt:*"), nullptr);
  EXPECT_EQ(find_solver_family("nlopt"), find_solver_family("nlopt:*"));
  EXPECT_EQ(find_solver_family("no-such-library"), nullptr);
  EXPECT_EQ(find_solver("nlopt:*"), nullptr);
  EXPECT_EQ(find_solver("nlopt:NO_SUCH_NAME"), nullptr);
  std::set<std::string_view> ids;
  for (const SolverEntry* entry : foreign()) {
    EXPECT_TRUE(ids.insert(entry->id).second) << entry->id;
    EXPECT_EQ(find_solver(entry->id), entry);
  }
  for (const char* id : {"nlopt:LN_BOBYQA", "nlopt:LN_COBYLA", "nlopt:LD_MMA", "nlopt:LD_SLSQP", "nlopt:LD_LBFGS",
                         "nlopt:GN_DIRECT_L", "nlopt:GN_CRS2_LM", "nlopt:GN_ISRES", "nlopt:GN_MLSL", "nlopt:GN_ESCH"}) {
    EXPECT_TRUE(ids.contains(id)) << id;
  }
  EXPECT_TRUE(find_solver("nlopt:LD_LBFGS")->uses_derivatives);
  EXPECT_FALSE(find_solver("nlopt:LN_BOBYQA")->uses_derivatives);
}

TEST(Foreign, EveryOneImprovesOnTheCentreOfTheBox) {
  const testing::Objective& objective = testing::sphere;
  const std::vector<double> centre(3, 0.5);
  const double before = testing::evaluate({centre, false}, 3, objective).cost[0];
  for (const SolverEntry* entry : foreign()) {
    EXPECT_LT(testing::drive(*entry, problem_of(3, 600), objective).best, 0.9 * before) << entry->id;
  }
}

TEST(Foreign, EveryOneCanBeLetGoAtAnyPoint) {
  for (const SolverEntry* entry : foreign()) {
    for (const int rounds : {0, 1, 2, 5, 40}) {
      const auto solver = entry->make(problem_of(4, 1000));
      for (int round = 0; round < rounds; ++round) {
        const Request request = solver->ask();
        if (request.points.empty()) break;
        for (const double u : request.points) ASSERT_TRUE(u >= 0.0 && u <= 1.0) << entry->id << ": " << u;
        solver->tell(request, testing::evaluate(request, 4, testing::rosenbrock));
      }
      // Let go while an answer is waited for.
      if (rounds > 0) {
        EXPECT_EQ(solver->ask().points.size() % 4, 0U) << entry->id;
      }
    }
  }
}

// Two runs in turns have each their own random state.
TEST(Foreign, RunsInTurnsDoNotDisturbEachOther) {
  for (const char* id : {"nlopt:GN_CRS2_LM", "nlopt:GN_ISRES"}) {
    const SolverEntry* entry = find_solver(id);
    ASSERT_NE(entry, nullptr);
    const testing::Run alone = testing::drive(*entry, problem_of(2, 200, 5), testing::rosenbrock);
    const auto first = entry->make(problem_of(2, 200, 5));
    const auto second = entry->make(problem_of(2, 200, 6));
    for (const testing::Exchange& exchange : alone.exchanges) {
      for (const auto* solver : {&first, &second}) {
        const Request request = (*solver)->ask();
        if (solver == &first) {
          ASSERT_EQ(request.points, exchange.request.points) << id;
        }
        (*solver)->tell(request, testing::evaluate(request, 2, testing::rosenbrock));
      }
    }
  }
}

double evaluations_to(const char* id, double target) {
  const testing::Run run = testing::drive(*find_solver(id), problem_of(2, 5000), testing::rosenbrock, {}, target);
  return run.used_at_target > 0 ? static_cast<double>(run.used_at_target) : 1e9;
}

// From the centre of the box, (0.5, 0.5) in Rosenbrock's own coordinates. Derivatives are charged as three evaluations.
TEST(Foreign, LocalAlgorithmsSolveRosenbrock) {
  EXPECT_LT(evaluations_to("nlopt:LN_BOBYQA", 1e-4), 300.0);
  EXPECT_LT(evaluations_to("nlopt:LN_SBPLX", 1e-4), 1500.0);
  EXPECT_LT(evaluations_to("nlopt:LD_LBFGS", 1e-4), 200.0);
  EXPECT_LT(evaluations_to("nlopt:LD_SLSQP", 1e-4), 200.0);
}

// Without recordings a cost may be any number, and the square of a negative one grows as the cost falls.
TEST(Foreign, NegativeCostsKeepTheirOrder) {
  for (const char* id : {"nlopt:LN_BOBYQA", "nlopt:LN_COBYLA", "nlopt:GN_DIRECT_L"}) {
    Problem problem = problem_of(2, 400);
    problem.recordings.clear();
    const auto solver = find_solver(id)->make(problem);
    double best = 1e9;
    for (std::size_t used = 0; used < problem.budget; ++used) {
      const Request request = solver->ask();
      if (request.points.empty()) break;
      const double x = request.points[0] - 0.3;
      const double y = request.points[1] - 0.8;
      // Some points have no cost, which must not look good beside those that have one.
      const bool diverged = x + y > 0.5;
      Response response;
      response.cost = {diverged ? diverged_cost : 100.0 * (x * x + y * y) - 5.0};
      best = std::min(best, response.cost[0]);
      solver->tell(request, response);
    }
    EXPECT_NEAR(best, -5.0, 1e-3) << id;
  }
}

TEST(Foreign, StartAndStepAreUsed) {
  Problem problem = problem_of(2, 50);
  problem.start = {0.25, 0.75};
  problem.settings = {{"step", 0.125}};
  const testing::Run run = testing::drive(*find_solver("nlopt:LN_NELDERMEAD"), problem, testing::sphere);
  ASSERT_GE(run.exchanges.size(), 3U);
  EXPECT_EQ(run.exchanges[0].request.points, problem.start);
  EXPECT_NEAR(std::fabs(run.exchanges[1].request.points[0] - 0.25), 0.125, 1e-12);
}

}  // namespace
}  // namespace hysteron
