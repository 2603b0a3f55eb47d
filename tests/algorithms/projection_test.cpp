// Variable projection outside the solvers: the bounded closed form, and what a solver sees of it.
#include "fit/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/algorithms/solver_harness.hpp"

namespace hysteron {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(const Stream& stream, Eigen::Index rows, Eigen::Index columns) {
  MatrixXd result(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      result(i, j) = stream.normal(static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(j));
    }
  }
  return result;
}

// Karush, Kuhn and Tucker: inside the slope is zero, on a bound it points out of the box.
TEST(Projection, BoundedMinimiserFulfilsItsConditions) {
  std::size_t on_bound = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const Stream stream(seed);
    const Eigen::Index d = 1 + static_cast<Eigen::Index>(seed % 8);
    const MatrixXd j = random_matrix(stream.child("J"), d + 2, d);
    const VectorXd r = random_matrix(stream.child("r"), d + 2, 1) * 2.0;
    const VectorXd low = VectorXd::Constant(d, -0.5);
    const VectorXd high = VectorXd::Constant(d, 0.5);
    const MatrixXd a = j.transpose() * j;
    const VectorXd g = j.transpose() * r;
    const VectorXd s = bounded_minimiser(a, g, low, high);
    const VectorXd slope = g + a * s;
    for (Eigen::Index k = 0; k < d; ++k) {
      ASSERT_GE(s[k], -0.5);
      ASSERT_LE(s[k], 0.5);
      if (s[k] == -0.5) {
        EXPECT_GT(slope[k], -1e-9);
        ++on_bound;
      } else if (s[k] == 0.5) {
        EXPECT_LT(slope[k], 1e-9);
        ++on_bound;
      } else {
        EXPECT_NEAR(slope[k], 0.0, 1e-9);
      }
    }
  }
  EXPECT_GT(on_bound, 200U);
}

// Residuals a_1 exp(-b_1 t) + a_2 exp(-b_2 t) - y: affine in the first and third coordinate. The truth is a = (0.7,
// 0.4), rates 4 * 0.25 and 4 * 0.8.
testing::Residuals exponentials(const double* u, std::size_t n) {
  constexpr std::size_t samples = 20;
  testing::Residuals out{std::vector<double>(samples), std::vector<double>(samples * n)};
  const auto term = [](double amplitude, double rate, double t) { return amplitude * std::exp(-4.0 * rate * t); };
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = 0.1 * static_cast<double>(k);
    out.value[k] = term(u[0], u[1], t) + term(u[2], u[3], t) - term(0.7, 0.25, t) - term(0.4, 0.8, t);
    out.jacobian[k * n] = term(1.0, u[1], t);
    out.jacobian[k * n + 1] = -4.0 * t * term(u[0], u[1], t);
    out.jacobian[k * n + 2] = term(1.0, u[3], t);
    out.jacobian[k * n + 3] = -4.0 * t * term(u[2], u[3], t);
  }
  return out;
}

Problem problem_of(std::size_t budget, std::vector<bool> linear) {
  Problem problem;
  problem.dimension = 4;
  problem.budget = budget;
  problem.stream = Stream(3).child("projection");
  problem.linear = std::move(linear);
  return problem;
}

TEST(Projection, SearchesFewerCoordinatesAtAnHonestPrice) {
  std::size_t points = 0;
  const auto evaluate = [&](const Request& request) {
    points += request.points.size() / 4;
    return testing::evaluate(request, 4, exponentials);
  };
  const RunResult with = run_projected(*find_solver("cma-es"), problem_of(1500, {true, false, true, false}), evaluate);
  // 499 points at 1 + 2 evaluations and one for the result.
  EXPECT_EQ(with.evaluations, 1498U);
  EXPECT_EQ(points, 500U);
  EXPECT_EQ(with.trace.back().best, with.cost);
  const Response again = evaluate({with.best, false});
  EXPECT_EQ(again.cost.front(), with.cost);
  EXPECT_LT(with.cost, 1e-6);
}

TEST(Projection, WithoutAffineCoordinatesNothingChanges) {
  const auto evaluate = [](const Request& request) { return testing::evaluate(request, 4, exponentials); };
  const Problem problem = problem_of(300, {false, false, false, false});
  const RunResult one = run_projected(*find_solver("pso"), problem, evaluate);
  const RunResult two = run_solver(*find_solver("pso"), problem, evaluate);
  EXPECT_EQ(one.best, two.best);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(Projection, AllAffineIsSolvedAtOnce) {
  const auto evaluate = [](const Request& request) { return testing::evaluate(request, 4, testing::sphere); };
  const RunResult run = run_projected(*find_solver("pso"), problem_of(100, {true, true, true, true}), evaluate);
  EXPECT_EQ(run.evaluations, 6U);
  EXPECT_LT(run.cost, 1e-9);
  EXPECT_FALSE(run.stopped().empty());
}

TEST(Projection, SolversThatProjectByThemselvesAreRefused) {
  const auto evaluate = [](const Request& request) { return testing::evaluate(request, 4, exponentials); };
  for (const char* id : {"lm", "multistart-lm", "ukf"}) {
    EXPECT_THROW(run_projected(*find_solver(id), problem_of(100, {true, false, true, false}), evaluate), InputError)
        << id;
  }
}

}  // namespace
}  // namespace hysteron
