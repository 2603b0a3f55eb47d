// Grasshopper optimisation algorithm.
//
//   X_i^d = c sum_{j != i} c (ub_d - lb_d)/2 s(delta_ij) (X_j^d - X_i^d) / |X_j - X_i| + T^d
//   s(r) = f exp(-r / l) - exp(-r),  f = 0.5, l = 1.5;   c = cmax - t (cmax - cmin) / T_max,  1 to 4e-5
//   T the best point so far
//
// Source: S. Saremi, S. Mirjalili, A. Lewis, Adv. Eng. Softw. 105:30-47, 2017, doi 10.1016/j.advengsoft.2017.01.004.
// Deviations and doubts:
// - The source maps distances into [1, 4] without a formula; its program uses 2 + (r mod 2) in the user's units, which
//   depends on the units. Here delta = 1 + 3 |X_j - X_i| / sqrt(n), that is exactly [1, 4] over the unit box.
// - The source writes s of the distance of one coordinate, its program of pairs of coordinates; here the distance of
//   the points is used, so that the result does not depend on the order of the coordinates.
// - T_max = budget / N. Coordinates outside the box are put on the bound. The method has no elite among the moving
//   points: only T is remembered. Its contraction is a schedule, not adapted to the cost, and draws nothing at random
//   after the start; the optimum at the centre of the box is favoured (a known objection).
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

extern const SolverEntry solver_grasshopper;

namespace {

using support::Point;

constexpr support::PopulationRule population{.usual = 30};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 10000.0, "grasshoppers; 0: 30, at most budget / 10"},
    {"cmax", 1.0, 1e-6, 10.0, "first value of the contraction c"},
    {"cmin", 4e-5, 1e-12, 1.0, "last value of the contraction c"},
    {"f", 0.5, 0.0, 1.0, "intensity of attraction"},
    {"l", 1.5, 0.1, 10.0, "length scale of attraction"},
};

class Grasshoppers final : public support::SamplingSolver {
 public:
  explicit Grasshoppers(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_grasshopper, population)),
        largest_(setting(problem, solver_grasshopper, "cmax")),
        smallest_(setting(problem, solver_grasshopper, "cmin")),
        intensity_(setting(problem, solver_grasshopper, "f")),
        length_(setting(problem, solver_grasshopper, "l")) {}

 protected:
  std::vector<Point> propose() override {
    if (generation_ == 0) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    }
    const double generations = static_cast<double>(problem_.budget) / static_cast<double>(count_);
    const double progress = generations > 0.0 ? std::min(1.0, static_cast<double>(generation_) / generations) : 1.0;
    const double c = largest_ - progress * (largest_ - smallest_);
    const double scale = 3.0 / std::sqrt(static_cast<double>(problem_.dimension));
    std::vector<Point> next;
    for (std::size_t i = 0; i < count_; ++i) {
      Point point(problem_.dimension, 0.0);
      for (std::size_t j = 0; j < count_; ++j) {
        const double between = support::distance(position_[i], position_[j]);
        if (!(between > 0.0)) continue;  // itself, or a coincident one: no direction
        const double mapped = 1.0 + scale * between;
        const double force = 0.5 * c * (intensity_ * std::exp(-mapped / length_) - std::exp(-mapped)) / between;
        for (std::size_t d = 0; d < point.size(); ++d) point[d] += force * (position_[j][d] - position_[i][d]);
      }
      for (std::size_t d = 0; d < point.size(); ++d) point[d] = support::clamp_unit(c * point[d] + target_[d]);
      next.push_back(std::move(point));
    }
    return next;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    position_ = points;
    const std::size_t best = support::argmin(cost);
    if (generation_ == 0 || cost[best] < target_cost_) {
      target_ = points[best];
      target_cost_ = cost[best];
    }
    ++generation_;
  }

 private:
  Problem problem_;
  std::size_t count_;
  double largest_;
  double smallest_;
  double intensity_;
  double length_;
  std::uint64_t generation_ = 0;
  std::vector<Point> position_;
  Point target_;
  double target_cost_ = 0.0;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_grasshopper);
  return std::make_unique<Grasshoppers>(problem);
}

}  // namespace

const SolverEntry solver_grasshopper = {
    "grasshopper",
    "Grasshopper optimisation algorithm",
    "Saremi, Mirjalili & Lewis, Adv. Eng. Softw. 105:30-47, 2017, doi 10.1016/j.advengsoft.2017.01.004",
    "Pairwise attraction and repulsion around the best point, contracted by a schedule over the budget. Distances are\n"
    "mapped linearly into [1, 4], which the source leaves open.",
    false,
    settings,
    make,
};

}  // namespace hysteron
