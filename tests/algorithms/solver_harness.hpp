// A driver and objectives for tests of solvers: sums of squares on the unit box with their derivatives.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "fit/solver.hpp"

namespace hysteron::testing {

// Residuals and their Jacobian (row-major) at a point of the unit box; an empty residual means diverged.
struct Residuals {
  std::vector<double> value;
  std::vector<double> jacobian;
};
using Objective = std::function<Residuals(const double* point, std::size_t dimension)>;

struct Exchange {
  Request request;  // as evaluated, that is truncated
  Response response;
};

struct Run {
  std::vector<Exchange> exchanges;
  std::size_t used = 0;
  double best = std::numeric_limits<double>::infinity();  // cost = sqrt(sum r^2)
  std::size_t used_at_target = 0;                         // 0: target not reached
  bool ended_by_itself = false;
  std::string reason;
};

inline Response evaluate(const Request& request, std::size_t dimension, const Objective& objective) {
  Response response;
  for (std::size_t first = 0; first < request.points.size(); first += dimension) {
    const Residuals residuals = objective(request.points.data() + first, dimension);
    double sum = 0.0;
    for (const double r : residuals.value) sum += r * r;
    response.cost.push_back(residuals.value.empty() ? diverged_cost : std::sqrt(sum));
    if (request.window) {
      response.residual.insert(response.residual.end(), residuals.value.begin(), residuals.value.end());
    }
    if (!request.derivatives) continue;
    for (std::size_t a = 0; a < dimension; ++a) {
      double component = 0.0;
      for (std::size_t k = 0; k < residuals.value.size(); ++k) {
        component += residuals.jacobian[k * dimension + a] * residuals.value[k];
      }
      response.gradient.push_back(component);
    }
    for (std::size_t a = 0; a < dimension; ++a) {
      for (std::size_t b = 0; b < dimension; ++b) {
        double component = 0.0;
        for (std::size_t k = 0; k < residuals.value.size(); ++k) {
          component += residuals.jacobian[k * dimension + a] * residuals.jacobian[k * dimension + b];
        }
        response.gauss_newton.push_back(component);
      }
    }
  }
  return response;
}

// Evaluates until the budget is used or the solver has finished. With `replayed`, the solver is first told those
// exchanges, as a resumed run would be; a mismatch of the requests ends the run with the reason "replay differs".
inline Run drive(const SolverEntry& entry, const Problem& problem, const Objective& objective,
                 const std::vector<Exchange>& replayed = {}, double target = -1.0) {
  const std::unique_ptr<Solver> solver = entry.make(problem);
  Run run;
  while (run.used < problem.budget) {
    Request request = solver->ask();
    if (request.points.empty()) {
      run.ended_by_itself = true;
      run.reason = solver->stopped_because();
      return run;
    }
    const std::size_t price = request.derivatives ? 1 + problem.dimension : 1;
    const std::size_t asked = request.points.size() / problem.dimension;
    const std::size_t affordable = (problem.budget - run.used) / price;
    Request truncated = request;
    truncated.points.resize(std::min(asked, affordable) * problem.dimension);
    Response response;
    if (run.exchanges.size() < replayed.size()) {
      const Exchange& known = replayed[run.exchanges.size()];
      if (known.request.points != truncated.points || known.request.derivatives != truncated.derivatives) {
        run.reason = "replay differs";
        return run;
      }
      response = known.response;
    } else {
      response = evaluate(truncated, problem.dimension, objective);
    }
    for (const double cost : response.cost) {
      run.used += price;
      run.best = std::min(run.best, cost);
      if (run.used_at_target == 0 && run.best <= target) run.used_at_target = run.used;
    }
    solver->tell(request, response);
    run.exchanges.push_back({truncated, response});
    if (affordable < asked) break;
  }
  return run;
}

// ---- objectives -------------------------------------------------------------------------------------------------

inline double optimum_coordinate(std::size_t d) { return 0.3 + 0.07 * static_cast<double>(d % 7); }

// sum of squares sum (x - o)^2 with x = 10 u - 5: off the centre, which some methods favour
inline Residuals sphere(const double* u, std::size_t n) {
  Residuals out{std::vector<double>(n), std::vector<double>(n * n, 0.0)};
  for (std::size_t d = 0; d < n; ++d) {
    out.value[d] = 10.0 * (u[d] - optimum_coordinate(d));
    out.jacobian[d * n + d] = 10.0;
  }
  return out;
}

// axis-parallel ellipsoid of condition 1e6 on [-5, 5]^n
inline Residuals ellipsoid(const double* u, std::size_t n) {
  Residuals out = sphere(u, n);
  for (std::size_t d = 0; d < n; ++d) {
    const double scale = n > 1 ? std::pow(10.0, 3.0 * static_cast<double>(d) / static_cast<double>(n - 1)) : 1.0;
    out.value[d] *= scale;
    out.jacobian[d * n + d] *= scale;
  }
  return out;
}

// Rosenbrock on [-2, 3]^n (for n = 1 only the linear term is left)
inline Residuals rosenbrock(const double* u, std::size_t n) {
  const std::size_t rows = n > 1 ? 2 * (n - 1) : 1;
  Residuals out{std::vector<double>(rows), std::vector<double>(rows * n, 0.0)};
  if (n == 1) {
    out.value[0] = 1.0 - (5.0 * u[0] - 2.0);
    out.jacobian[0] = -5.0;
    return out;
  }
  for (std::size_t d = 0; d + 1 < n; ++d) {
    const double x = 5.0 * u[d] - 2.0;
    const double y = 5.0 * u[d + 1] - 2.0;
    out.value[2 * d] = 1.0 - x;
    out.value[2 * d + 1] = 10.0 * (y - x * x);
    out.jacobian[2 * d * n + d] = -5.0;
    out.jacobian[(2 * d + 1) * n + d] = -100.0 * x;
    out.jacobian[(2 * d + 1) * n + d + 1] = 50.0;
  }
  return out;
}

inline Residuals constant(const double* /*u*/, std::size_t n) { return {{2.0}, std::vector<double>(n, 0.0)}; }

// diverged except in a cube of half width 0.05 around the optimum
inline Residuals needle(const double* u, std::size_t n) {
  for (std::size_t d = 0; d < n; ++d) {
    if (std::fabs(u[d] - optimum_coordinate(d)) > 0.05) return {};
  }
  return sphere(u, n);
}

inline Residuals diverged(const double* /*u*/, std::size_t /*n*/) { return {}; }

}  // namespace hysteron::testing
