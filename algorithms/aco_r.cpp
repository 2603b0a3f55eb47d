// Ant colony optimisation for continuous domains.
//
//   archive of k points sorted by cost;  weight of rank r:  exp(-(r - 1)^2 / (2 q^2 k^2)) / (q k sqrt(2 pi))
//   each ant draws one archive point l by weight and samples every coordinate from
//     N( s_l^d, sigma ),  sigma = xi / (k - 1) sum_e |s_e^d - s_l^d|
//   the m ants join the archive, of which the best k stay
//
// Source: K. Socha, M. Dorigo, Eur. J. Oper. Res. 185(3):1155-1173, 2008, doi 10.1016/j.ejor.2006.06.046 (k = 50, m =
// 2,
//   q = 1e-4, xi = 0.85 for the general tests).
// Deviations and choices:
// - The rotation of the coordinates by which the source treats correlated variables is left out.
// - With q = 1e-4 nearly every ant takes the best point, as in the source; exp underflows to 0 for the others.
// - A coordinate outside the box is mirrored into it.
// - When every sigma around the best point is below 1e-12 the archive is drawn anew, the best point kept.
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

extern const SolverEntry solver_aco_r;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"archive", 50.0, 2.0, 100000.0, "size of the archive (k)"},
    {"ants", 2.0, 1.0, 100000.0, "ants of one generation (m)"},
    {"q", 1e-4, 1e-9, 10.0, "locality: how strongly the best of the archive are preferred"},
    {"xi", 0.85, 0.01, 10.0, "speed of convergence: width of the sampling"},
};

class AntColony final : public support::SamplingSolver {
 public:
  explicit AntColony(const Problem& problem)
      : problem_(problem),
        size_(support::whole_setting(problem, solver_aco_r, "archive")),
        ants_(support::whole_setting(problem, solver_aco_r, "ants")),
        width_(setting(problem, solver_aco_r, "xi")),
        moves_(problem.stream.child("moves")),
        restarts_(problem.stream.child("restarts")) {
    // The common factor of the weights cancels; the cumulative sum starts with 1 and cannot vanish.
    const double scale = setting(problem, solver_aco_r, "q") * static_cast<double>(size_);
    double total = 0.0;
    for (std::size_t rank = 0; rank < size_; ++rank) {
      const double ratio = static_cast<double>(rank) / scale;
      total += std::exp(-0.5 * ratio * ratio);
      cumulative_.push_back(total);
    }
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ == 0) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, size_);
    }
    if (collapsed_) {
      std::vector<Point> points;
      for (std::size_t i = 0; i + 1 < size_; ++i) {
        Draws draws(restarts_, generation_, i);
        points.push_back(support::random_point(draws, problem_.dimension));
      }
      return points;
    }
    std::vector<Point> points;
    for (std::size_t ant = 0; ant < ants_; ++ant) {
      Draws draws(moves_, generation_, ant);
      const double pointer = cumulative_.back() * draws.uniform();
      std::size_t guide = 0;
      while (guide + 1 < size_ && pointer > cumulative_[guide]) ++guide;
      Point point(problem_.dimension);
      for (std::size_t d = 0; d < point.size(); ++d) {
        point[d] = support::mirror_unit(archive_[guide][d] + deviation(guide, d) * draws.normal());
      }
      points.push_back(std::move(point));
    }
    return points;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (collapsed_) {
      archive_.resize(1);
      cost_.resize(1);
    }
    archive_.insert(archive_.end(), points.begin(), points.end());
    cost_.insert(cost_.end(), cost.begin(), cost.end());
    std::vector<Point> sorted;
    std::vector<double> sorted_cost;
    for (const std::size_t i : support::ascending(cost_)) {
      if (sorted.size() == size_) break;
      sorted.push_back(std::move(archive_[i]));
      sorted_cost.push_back(cost_[i]);
    }
    archive_ = std::move(sorted);
    cost_ = std::move(sorted_cost);
    collapsed_ = true;
    for (std::size_t d = 0; d < problem_.dimension; ++d) collapsed_ = collapsed_ && deviation(0, d) < 1e-12;
    ++generation_;
  }

 private:
  [[nodiscard]] double deviation(std::size_t guide, std::size_t d) const {
    double sum = 0.0;
    for (const Point& point : archive_) sum += std::fabs(point[d] - archive_[guide][d]);
    return width_ * sum / static_cast<double>(size_ - 1);
  }

  Problem problem_;
  std::size_t size_;
  std::size_t ants_;
  double width_;
  Stream moves_;
  Stream restarts_;
  std::vector<double> cumulative_;
  std::uint64_t generation_ = 0;
  bool collapsed_ = false;
  std::vector<Point> archive_;  // sorted, best first
  std::vector<double> cost_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_aco_r);
  return std::make_unique<AntColony>(problem);
}

}  // namespace

const SolverEntry solver_aco_r = {
    "aco-r",
    "Ant colony optimisation for continuous domains",
    "Socha & Dorigo, Eur. J. Oper. Res. 185(3):1155-1173, 2008, doi 10.1016/j.ejor.2006.06.046",
    "Gaussian sampling around an archive of good points, without the rotation of the coordinates. Coordinates outside\n"
    "the box are mirrored; a collapsed archive is drawn anew, its best point kept.",
    false,
    settings,
    make,
};

}  // namespace hysteron
