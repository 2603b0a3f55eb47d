// Levenberg-Marquardt of MINPACK as minpack:lmder, in the C of cminpack. Built where that is installed
// (HYSTERON_MINPACK), else the family is not there.
//
//   minimise |r(u)|^2,  u = (1 + sin t) / 2,  over t
//
// Source: J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, Lecture Notes in Mathematics 630
// (1978) 105-116, doi 10.1007/BFb0067700; J. J. More, B. S. Garbow, K. E. Hillstrom, User Guide for MINPACK-1,
// ANL-80-74, 1980.
// What is done here and not by the library:
// - It knows no bounds: the sine of MINUIT (F. James, M. Roos, Comput. Phys. Commun. 10 (1975) 343-367, doi
//   10.1016/0010-4655(75)90039-9) maps all t into the box. A start on a bound, where the sine is flat, is moved inside.
// - It is not told all samples, but d + 1 numbers that are as good: with J^T J = V L V^T and g = J^T r, the rows
//   L^(1/2) V^T stand for J and L^(-1/2) V^T g, filled up to the same norm, for r. The library uses no more of them
//   than J^T J, J^T r and |r|. Of a point without derivatives it uses |r| alone.
// - Another start, uniform in the box, when it ends by its tolerances; the best of all is kept.
#include <cminpack.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/support/rendezvous.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_minpack;

namespace {

using support::Answer;
using support::ForeignSolver;
using support::Point;

constexpr Setting settings[] = {
    {"ftol", 1e-8, 0.0, 1.0, "a start ends when the squared cost changes less, relative to it"},
    {"xtol", 1e-8, 0.0, 1.0, "a start ends when a step is smaller, relative to the point"},
    {"factor", 100.0, 0.1, 100.0, "first step bound, as a multiple of the scaled point"},
};

// Nearest to a bound that a start may be: at 1e-3 the sine's slope is 0.03.
constexpr double off_bound = 1e-3;

Point in_box(const double* t, int dimension) {
  Point u(static_cast<std::size_t>(dimension));
  for (std::size_t d = 0; d < u.size(); ++d) {
    u[d] = std::isfinite(t[d]) ? support::clamp_unit(0.5 + 0.5 * std::sin(t[d])) : 0.5;
  }
  return u;
}

// What the library's function is handed.
struct Call {
  const ForeignSolver::Evaluate* evaluate;
  bool stopped = false;
};

// The residuals of a point without derivatives: their norm is all that is used.
void put_cost(double cost, double* residual, int rows) {
  std::fill(residual, residual + rows, 0.0);
  residual[rows - 1] = cost;
}

// `jacobian` column by column, by t.
void put_derivatives(const Answer& answer, const double* t, double* residual, double* jacobian, int rows, int columns) {
  const Eigen::Map<const Eigen::MatrixXd> matrix(answer.gauss_newton.data(), columns, columns);
  const Eigen::Map<const Eigen::VectorXd> gradient(answer.gradient.data(), columns);
  Eigen::Map<Eigen::MatrixXd> j(jacobian, rows, columns);
  j.setZero();
  put_cost(answer.cost, residual, rows);
  if (!matrix.allFinite() || !gradient.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  const double least = std::numeric_limits<double>::epsilon() * std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  double rest = answer.cost * answer.cost;
  for (int k = 0; k < columns; ++k) {
    const double value = eigen.eigenvalues()[k];
    if (value <= least) continue;
    const auto vector = eigen.eigenvectors().col(k);
    j.row(k) = std::sqrt(value) * vector.transpose();
    residual[k] = vector.dot(gradient) / std::sqrt(value);
    rest -= residual[k] * residual[k];
  }
  residual[rows - 1] = std::sqrt(std::max(rest, 0.0));
  for (int d = 0; d < columns; ++d) j.col(d) *= 0.5 * std::cos(t[d]);
}

// 1: the residuals of a point; 2: its derivatives. Negative: stop.
int evaluate(void* data, int rows, int columns, const double* t, double* residual, double* jacobian, int /*stride*/,
             int wanted) {
  auto& call = *static_cast<Call*>(data);
  const std::optional<Answer> answer = (*call.evaluate)(in_box(t, columns), wanted == 2);
  if (!answer) {
    call.stopped = true;
    return -1;
  }
  if (wanted == 2) {
    put_derivatives(*answer, t, residual, jacobian, rows, columns);
  } else {
    put_cost(answer->cost, residual, rows);
  }
  return 0;
}

std::string optimise(const Problem& problem, const ForeignSolver::Evaluate& evaluate_point) {
  const int columns = static_cast<int>(problem.dimension);
  const int rows = columns + 1;
  const std::size_t n = problem.dimension;
  const Stream starts = problem.stream.child("starts");
  Call call{&evaluate_point};
  for (std::uint64_t start = 0; !call.stopped; ++start) {
    Point u(n, 0.5);
    if (start == 0 && !problem.start.empty()) u = support::clamped(problem.start);
    std::vector<double> t(n);
    for (std::size_t d = 0; d < n; ++d) {
      if (start > 0) u[d] = starts.uniform(start, static_cast<std::uint32_t>(d));
      t[d] = std::asin(2.0 * std::clamp(u[d], off_bound, 1.0 - off_bound) - 1.0);
    }
    std::vector<double> residual(n + 1);
    std::vector<double> jacobian((n + 1) * n);
    std::vector<double> scale(n);
    std::vector<int> order(n);
    std::vector<double> work(4 * n + n + 1);
    int calls = 0;
    int jacobians = 0;
    lmder(&evaluate, &call, rows, columns, t.data(), residual.data(), jacobian.data(), rows,
          setting(problem, solver_minpack, "ftol"), setting(problem, solver_minpack, "xtol"), 0.0,
          std::numeric_limits<int>::max(), scale.data(), 1, setting(problem, solver_minpack, "factor"), 0, &calls,
          &jacobians, order.data(), work.data(), work.data() + n, work.data() + 2 * n, work.data() + 3 * n,
          work.data() + 4 * n);
  }
  return "abandoned";
}

constexpr const char* title = "MINPACK: Levenberg-Marquardt (lmder), restarted";

const SolverEntry lmder_entry = {
    "minpack:lmder",
    title,
    "More, Lecture Notes in Mathematics 630 (1978) 105-116, doi 10.1007/BFb0067700",
    "Levenberg-Marquardt in MINPACK's trust region, over t with u = (1 + sin t) / 2 as in MINUIT; from the start "
    "given,\n"
    "else the centre, then from uniform points until the budget is used. Built only where cminpack is installed.",
    true,
    settings,
    [](const Problem& problem) -> std::unique_ptr<Solver> {
      support::check_problem(problem, solver_minpack);
      return std::make_unique<ForeignSolver>(
          [problem](const ForeignSolver::Evaluate& ask) { return optimise(problem, ask); });
    },
};

std::span<const SolverEntry* const> members() {
  static const SolverEntry* const rows[] = {&lmder_entry};
  return rows;
}

}  // namespace

const SolverEntry solver_minpack = {
    "minpack:*", "Least squares of MINPACK", lmder_entry.reference, lmder_entry.description, true, settings, nullptr,
    members,
};

}  // namespace hysteron
