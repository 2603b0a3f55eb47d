#include "fit/projection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace hysteron {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class At : char { lower, upper, free };

// Minimiser with the coordinates on bounds held there.
VectorXd with_held(const MatrixXd& a, const VectorXd& g, const std::vector<At>& at, const VectorXd& s) {
  std::vector<Index> free;
  for (Index k = 0; k < g.size(); ++k) {
    if (at[static_cast<std::size_t>(k)] == At::free) free.push_back(k);
  }
  VectorXd result = s;
  if (free.empty()) return result;
  const auto m = static_cast<Index>(free.size());
  MatrixXd sub(m, m);
  VectorXd right(m);
  for (Index i = 0; i < m; ++i) {
    const Index row = free[static_cast<std::size_t>(i)];
    right[i] = -g[row];
    for (Index k = 0; k < g.size(); ++k) {
      if (at[static_cast<std::size_t>(k)] != At::free) right[i] -= a(row, k) * s[k];
    }
    for (Index j = 0; j < m; ++j) sub(i, j) = a(row, free[static_cast<std::size_t>(j)]);
    sub(i, i) *= 1.0 + 1e-12;
    if (sub(i, i) == 0.0) sub(i, i) = 1.0;  // a column without influence stays where it is
  }
  const VectorXd solved = sub.ldlt().solve(right);
  for (Index i = 0; i < m; ++i) {
    if (std::isfinite(solved[i])) result[free[static_cast<std::size_t>(i)]] = solved[i];
  }
  return result;
}

}  // namespace

VectorXd bounded_minimiser(const MatrixXd& a, const VectorXd& g, const VectorXd& lower, const VectorXd& upper) {
  const Index d = g.size();
  VectorXd s = VectorXd::Zero(d).cwiseMax(lower).cwiseMin(upper);
  std::vector<At> at(static_cast<std::size_t>(d), At::free);
  // Every pass holds or frees a coordinate; the cost falls between two frees, so that no set of bounds comes twice but
  // by rounding, against which the passes are limited.
  for (Index pass = 0; pass < 10 * (d + 1); ++pass) {
    const VectorXd goal = with_held(a, g, at, s);
    double share = 1.0;
    Index blocking = -1;
    for (Index k = 0; k < d; ++k) {
      const double step = goal[k] - s[k];
      const double room = step > 0.0 ? upper[k] - s[k] : lower[k] - s[k];
      if (step != 0.0 && room / step < share) {
        share = std::max(0.0, room / step);
        blocking = k;
      }
    }
    s = (s + share * (goal - s)).cwiseMax(lower).cwiseMin(upper);
    if (blocking >= 0) {
      const bool up = goal[blocking] > s[blocking];
      at[static_cast<std::size_t>(blocking)] = up ? At::upper : At::lower;
      s[blocking] = up ? upper[blocking] : lower[blocking];
      continue;
    }
    const VectorXd slope = g + a * s;
    double strongest = 1e-12 * (g.cwiseAbs().maxCoeff() + 1e-300);
    Index freed = -1;
    for (Index k = 0; k < d; ++k) {
      const At where = at[static_cast<std::size_t>(k)];
      const double gain = where == At::lower ? -slope[k] : where == At::upper ? slope[k] : 0.0;
      if (gain > strongest) {
        strongest = gain;
        freed = k;
      }
    }
    if (freed < 0) break;
    at[static_cast<std::size_t>(freed)] = At::free;
  }
  return s;
}

std::string projection_refusal(const SolverEntry& entry) {
  if (entry.uses_derivatives) {
    return "solver '" + std::string(entry.id) +
           "' uses derivatives, expected one that does not: those of the Levenberg-Marquardt family project by "
           "themselves";
  }
  if (entry.id == "ukf") return "solver 'ukf' follows the recordings in time, expected one that sees costs only";
  return {};
}

RunResult run_projected(const SolverEntry& entry, const Problem& problem, const Evaluate& evaluate,
                        const Observer& observer) {
  if (const std::string why = projection_refusal(entry); !why.empty()) throw InputError(why);
  std::vector<std::size_t> searched;
  std::vector<std::size_t> affine;
  for (std::size_t k = 0; k < problem.dimension; ++k) {
    (k < problem.linear.size() && problem.linear[k] ? affine : searched).push_back(k);
  }
  if (affine.empty()) return run_solver(entry, problem, evaluate, observer);
  const auto d = static_cast<Index>(problem.dimension);
  const auto m = static_cast<Index>(affine.size());
  const std::size_t price = 1 + affine.size();

  std::vector<double> best;
  double best_cost = 3.0 * diverged_cost;
  // Costs of points of the searched coordinates, the affine ones at their optimum.
  const auto projected = [&](const Request& request) {
    const std::size_t count = searched.empty() ? 1 : request.points.size() / searched.size();
    Request whole;
    whole.derivatives = true;
    whole.points.assign(count * problem.dimension, 0.5);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t j = 0; j < searched.size(); ++j) {
        whole.points[k * problem.dimension + searched[j]] = request.points[k * searched.size() + j];
      }
    }
    const Response at_middle = evaluate(whole);
    Response response;
    for (std::size_t k = 0; k < at_middle.cost.size(); ++k) {
      double cost = at_middle.cost[k];
      const auto row = whole.points.begin() + static_cast<std::ptrdiff_t>(k * problem.dimension);
      std::vector<double> point(row, row + static_cast<std::ptrdiff_t>(problem.dimension));
      if (cost < diverged_cost) {
        const Eigen::Map<const VectorXd> gradient(at_middle.gradient.data() + static_cast<Index>(k) * d, d);
        const Eigen::Map<const MatrixXd> matrix(at_middle.gauss_newton.data() + static_cast<Index>(k) * d * d, d, d);
        VectorXd g(m);
        MatrixXd a(m, m);
        for (Index i = 0; i < m; ++i) {
          const auto column = static_cast<Index>(affine[static_cast<std::size_t>(i)]);
          g[i] = gradient[column];
          for (Index j = 0; j < m; ++j)
            a(i, j) = matrix(column, static_cast<Index>(affine[static_cast<std::size_t>(j)]));
        }
        const VectorXd s = bounded_minimiser(a, g, VectorXd::Constant(m, -0.5), VectorXd::Constant(m, 0.5));
        cost = std::sqrt(std::max(0.0, cost * cost + 2.0 * g.dot(s) + s.dot(a * s)));
        for (Index i = 0; i < m; ++i) point[affine[static_cast<std::size_t>(i)]] = 0.5 + s[i];
      }
      if (cost < best_cost) {
        best_cost = cost;
        best = std::move(point);
      }
      response.cost.push_back(cost);
    }
    return response;
  };

  RunResult result;
  if (searched.empty()) {
    result.solver = std::string(entry.id);
    if (problem.budget > price) {
      projected({});
      result.evaluations = 1;
    }
    result.reason = "every coordinate is affine: solved in closed form";
  } else {
    Problem reduced = problem;
    reduced.dimension = searched.size();
    reduced.budget = problem.budget > 1 ? (problem.budget - 1) / price : 0;
    reduced.linear.assign(searched.size(), false);
    reduced.screening = false;
    reduced.recordings.clear();
    reduced.states = 0;
    if (!problem.start.empty()) {
      reduced.start.clear();
      for (const std::size_t k : searched) reduced.start.push_back(problem.start[k]);
    }
    result = run_solver(entry, reduced, projected, observer);
  }
  result.budget = problem.budget;
  result.evaluations *= price;
  for (TracePoint& point : result.trace) point.evaluations *= price;
  result.best = best;
  result.cost = best_cost;
  if (best.empty() || result.ended_by == EndedBy::interruption) return result;
  Request last;
  last.points = best;
  result.cost = evaluate(last).cost.front();
  ++result.evaluations;
  if (!result.trace.empty()) {
    result.trace.back().best = result.cost;
  } else {
    result.trace.push_back({result.evaluations, result.cost});
  }
  return result;
}

}  // namespace hysteron
