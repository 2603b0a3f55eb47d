// Crow search.
//
//   crow i follows a random crow j:  x_i <- x_i + r fl (m_j - x_i)  if r_j >= AP,  else x_i <- random point
//   memory m_i: the best point crow i has been at;  r, r_j ~ U(0,1), one per crow
//
// Source: A. Askarzadeh, Computers & Structures 169:1-12, 2016, doi 10.1016/j.compstruc.2016.03.001 (AP = 0.1, fl = 2,
//   20 to 50 crows).
// Deviations and choices:
// - A move out of the box is cut at the bound, coordinate by coordinate. In the source such a crow stays where it is
//   (`bounds` 0). Only moves beyond the memory, l = r fl > 1, can leave the box, and only they keep the flock apart:
//   with x_i and m_j independent and of one variance the next x_i has (1 - l)^2 + l^2 times that, in the mean 2/3 for
//   l < 1 and 8/3 for 1 < l < 2. Where they are refused the flock draws together around the middle of the box, and
//   with a small budget it ends above random search if the optimum is near an end of some ranges.
// - A crow that stays is not evaluated (the source evaluates the old point again).
// - 20 crows where the budget holds 20 generations of them, else fewer: a crow learns once a generation.
// - AP = 0.2: with 0.1 so few crows have too rarely one at a random place. From 1000 evaluations on it hardly matters.
// - `population` 20 or more, `awareness` 0.1 and `bounds` 0 are the source's method.
// - If no crow of a generation moves, further generations are drawn without evaluations; after 1000 of them one crow
//   is sent to a random point.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_crow_search;

namespace {

using support::Draws;
using support::Point;

constexpr support::PopulationRule population{.usual = 20, .generations = 20};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "crows; 0: 20, at most budget / 20"},
    {"awareness", 0.2, 0.0, 1.0, "AP: probability that the followed crow leads to a random place; 0.1 in the source"},
    {"flight", 2.0, 0.01, 10.0, "fl: flight length"},
    {"bounds", 1.0, 0.0, 1.0, "1 a move out of the box is cut at the bound, 0 the crow stays, as in the source"},
};

class CrowSearch final : public support::SamplingSolver {
 public:
  explicit CrowSearch(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_crow_search, population)),
        awareness_(setting(problem, solver_crow_search, "awareness")),
        flight_(setting(problem, solver_crow_search, "flight")),
        clip_(support::whole_setting(problem, solver_crow_search, "bounds") == 1),
        moves_(problem.stream.child("moves")) {}

 protected:
  std::vector<Point> propose() override {
    moved_.clear();
    if (generation_ == 0) {
      position_ = support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
      for (std::size_t i = 0; i < count_; ++i) moved_.push_back(i);
      return position_;
    }
    std::vector<Point> points;
    for (int idle = 0; idle < 1000; ++idle) {
      for (std::size_t i = 0; i < count_; ++i) fly(i, points);
      if (!points.empty()) return points;
      ++generation_;
    }
    Draws draws(moves_, generation_, count_);
    moved_.push_back(0);
    return {support::random_point(draws, problem_.dimension)};
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (generation_ == 0) {
      memory_ = points;
      memory_cost_ = cost;
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t i = moved_[k];
      position_[i] = points[k];
      if (cost[k] < memory_cost_[i]) {
        memory_[i] = points[k];
        memory_cost_[i] = cost[k];
      }
    }
    ++generation_;
  }

 private:
  void fly(std::size_t i, std::vector<Point>& points) {
    Draws draws(moves_, generation_, i);
    const std::size_t followed = draws.below(count_);
    Point point;
    if (draws.uniform() >= awareness_) {
      const double length = flight_ * draws.uniform();
      point = position_[i];
      bool inside = true;
      bool same = true;
      for (std::size_t d = 0; d < point.size(); ++d) {
        point[d] += length * (memory_[followed][d] - point[d]);
        inside = inside && point[d] >= 0.0 && point[d] <= 1.0;
        point[d] = support::clamp_unit(point[d]);
        same = same && !(point[d] < position_[i][d]) && !(point[d] > position_[i][d]);
      }
      if (same || (!inside && !clip_)) return;
    } else {
      point = support::random_point(draws, problem_.dimension);
    }
    moved_.push_back(i);
    points.push_back(std::move(point));
  }

  Problem problem_;
  std::size_t count_;
  double awareness_;
  double flight_;
  bool clip_;
  Stream moves_;
  std::uint64_t generation_ = 0;
  std::vector<Point> position_;
  std::vector<Point> memory_;
  std::vector<double> memory_cost_;
  std::vector<std::size_t> moved_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_crow_search);
  return std::make_unique<CrowSearch>(problem);
}

}  // namespace

const SolverEntry solver_crow_search = {
    "crow-search",
    "Crow search",
    "Askarzadeh, Computers & Structures 169:1-12, 2016, doi 10.1016/j.compstruc.2016.03.001",
    "Each crow flies towards the memory of a random crow and beyond, or to a random place with probability AP. A move\n"
    "out of the box is cut at the bound; in the source the crow stays where it is, which draws the flock to the "
    "middle.",
    false,
    settings,
    make,
};

}  // namespace hysteron
