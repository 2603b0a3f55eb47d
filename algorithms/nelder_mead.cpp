// Nelder-Mead simplex in the unit box, with restarts.
//
//   reflection  xr = c + a (c - xw);  expansion xe = c + a b (c - xw);  outside contraction xo = c + g a (c - xw);
//   inside contraction xi = c - g (c - xw);  shrink x_i = x_1 + d (x_i - x_1);  c the centroid of all but the worst
//   classical: a = 1, b = 2, g = 1/2, d = 1/2;  adaptive: a = 1, b = 1 + 2/n, g = 3/4 - 1/(2n), d = 1 - 1/n
//
// Sources: J. A. Nelder, R. Mead, Computer J. 7:308-313, 1965, doi 10.1093/comjnl/7.4.308; J. C. Lagarias et al.,
//   SIAM J. Optim. 9:112-147, 1998, doi 10.1137/S1052623496303470 (order of the tests); F. Gao, L. Han, Comput. Optim.
//   Appl. 51:259-277, 2012, doi 10.1007/s10589-010-9329-3 (adaptive coefficients).
// Deviations and choices:
// - n = 1 takes the classical coefficients: the adaptive ones would give d = 0.
// - Bounds: a trial point outside the box is mirrored into it; clipping would flatten the simplex onto the bound.
// - Start simplex: `step` along each axis towards the farther bound.
// - Restart from a uniform random point when the simplex has collapsed: its largest coordinate difference from the
//   best vertex <= `tolerance`, or <= 1e-4 with equal costs; or when every vertex has diverged.
//   A restart keeps nothing: the driver remembers the best point.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_nelder_mead;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"adaptive", 1.0, 0.0, 1.0, "1 coefficients of Gao & Han, 0 classical"},
    {"step", 0.1, 1e-6, 0.5, "edge of the start simplex as a fraction of the range"},
    {"tolerance", 1e-9, 1e-15, 0.1, "size of the simplex, as a fraction of the range, at which it is restarted"},
};

enum class Stage { simplex, reflection, expansion, outside, inside, shrink };

class NelderMead final : public support::SamplingSolver {
 public:
  explicit NelderMead(const Problem& problem)
      : problem_(problem),
        step_(setting(problem, solver_nelder_mead, "step")),
        tolerance_(setting(problem, solver_nelder_mead, "tolerance")),
        restarts_(problem.stream.child("restarts")) {
    const double n = static_cast<double>(problem.dimension);
    if (support::whole_setting(problem, solver_nelder_mead, "adaptive") == 1 && problem.dimension > 1) {
      expansion_ = 1.0 + 2.0 / n;
      contraction_ = 0.75 - 0.5 / n;
      shrink_ = 1.0 - 1.0 / n;
    }
  }

  [[nodiscard]] Ends ends() const override { return ends_; }

 protected:
  std::vector<Point> propose() override {
    switch (stage_) {
      case Stage::simplex:
        return start_simplex();
      case Stage::reflection:
        return {along(1.0)};
      case Stage::expansion:
        return {along(expansion_)};
      case Stage::outside:
        return {along(contraction_)};
      case Stage::inside:
        return {along(-contraction_)};
      case Stage::shrink:
        break;
    }
    std::vector<Point> points(vertex_.begin() + 1, vertex_.end());
    for (Point& point : points) {
      for (std::size_t d = 0; d < point.size(); ++d) {
        point[d] = support::clamp_unit(vertex_[0][d] + shrink_ * (point[d] - vertex_[0][d]));
      }
    }
    return points;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    const double worst = stage_ == Stage::simplex ? 0.0 : cost_.back();
    switch (stage_) {
      case Stage::simplex:
        vertex_ = points;
        cost_ = cost;
        ++starts_;
        next_iteration();
        return;
      case Stage::reflection:
        reflected_ = points[0];
        reflected_cost_ = cost[0];
        if (cost[0] < cost_.front()) {
          stage_ = Stage::expansion;
        } else if (cost[0] < cost_[cost_.size() - 2] && problem_.dimension > 1) {
          replace_worst(points[0], cost[0]);
        } else {
          stage_ = cost[0] < worst ? Stage::outside : Stage::inside;
        }
        return;
      case Stage::expansion:
        if (cost[0] < reflected_cost_) {
          replace_worst(points[0], cost[0]);
        } else {
          replace_worst(reflected_, reflected_cost_);
        }
        return;
      case Stage::outside:
        if (cost[0] <= reflected_cost_) {
          replace_worst(points[0], cost[0]);
        } else {
          stage_ = Stage::shrink;
        }
        return;
      case Stage::inside:
        if (cost[0] < worst) {
          replace_worst(points[0], cost[0]);
        } else {
          stage_ = Stage::shrink;
        }
        return;
      case Stage::shrink:
        for (std::size_t i = 0; i < points.size(); ++i) {
          vertex_[i + 1] = points[i];
          cost_[i + 1] = cost[i];
        }
        next_iteration();
        return;
    }
  }

 private:
  std::vector<Point> start_simplex() const {
    Draws draws(restarts_, starts_, 0);
    Point corner = support::random_point(draws, problem_.dimension);
    if (starts_ == 0 && !problem_.start.empty()) corner = support::clamped(problem_.start);
    std::vector<Point> points(problem_.dimension + 1, corner);
    for (std::size_t d = 0; d < problem_.dimension; ++d) points[d + 1][d] += corner[d] < 0.5 ? step_ : -step_;
    return points;
  }

  // centroid + factor (centroid - worst), mirrored into the box
  [[nodiscard]] Point along(double factor) const {
    Point point(problem_.dimension);
    const std::size_t last = vertex_.size() - 1;
    for (std::size_t d = 0; d < point.size(); ++d) {
      double centroid = 0.0;
      for (std::size_t i = 0; i < last; ++i) centroid += vertex_[i][d];
      centroid /= static_cast<double>(last);
      point[d] = support::mirror_unit(centroid + factor * (centroid - vertex_[last][d]));
    }
    return point;
  }

  void replace_worst(const Point& point, double cost) {
    vertex_.back() = point;
    cost_.back() = cost;
    next_iteration();
  }

  void next_iteration() {
    std::vector<Point> sorted;
    std::vector<double> sorted_cost;
    for (const std::size_t i : support::ascending(cost_)) {
      sorted.push_back(std::move(vertex_[i]));
      sorted_cost.push_back(cost_[i]);
    }
    vertex_ = std::move(sorted);
    cost_ = std::move(sorted_cost);
    double size = 0.0;
    for (const Point& point : vertex_) {
      for (std::size_t d = 0; d < point.size(); ++d) size = std::max(size, std::fabs(point[d] - vertex_[0][d]));
    }
    const bool flat = cost_.back() <= cost_.front();
    const bool collapsed = size <= tolerance_ || (flat && size <= 1e-4) || cost_.front() >= diverged_cost;
    stage_ = collapsed ? Stage::simplex : Stage::reflection;
    if (collapsed) ends_.add(cost_.front());
  }

  Problem problem_;
  double step_;
  double tolerance_;
  Stream restarts_;
  double expansion_ = 2.0;
  double contraction_ = 0.5;
  double shrink_ = 0.5;
  Stage stage_ = Stage::simplex;
  std::uint64_t starts_ = 0;
  Ends ends_;
  std::vector<Point> vertex_;  // sorted, best first
  std::vector<double> cost_;
  Point reflected_;
  double reflected_cost_ = 0.0;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_nelder_mead);
  return std::make_unique<NelderMead>(problem);
}

}  // namespace

const SolverEntry solver_nelder_mead = {
    "nelder-mead",
    "Nelder-Mead simplex with restarts",
    "Gao & Han, Comput. Optim. Appl. 51:259-277, 2012, doi 10.1007/s10589-010-9329-3; Nelder & Mead, Computer J.\n"
    "7:308-313, 1965, doi 10.1093/comjnl/7.4.308",
    "Coefficients adapted to the dimension, or the classical ones. Trial points outside the box are mirrored into it;\n"
    "a collapsed simplex is restarted from a uniform random point until the budget is used.",
    false,
    settings,
    make,
};

}  // namespace hysteron
