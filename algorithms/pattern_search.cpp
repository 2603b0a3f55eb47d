// Generalised pattern search with the positive basis of 2n coordinate directions, and restarts.
//
//   poll x + h d for d in {+e_1, -e_1, ..., +e_n, -e_n};  success: move, h <- min(expand h, 1);
//   no success: h <- contract h
//
// Source: V. Torczon, SIAM J. Optim. 7:1-25, 1997, doi 10.1137/S1052623493250780; R. M. Lewis, V. Torczon, SIAM J.
//   Optim. 9:1082-1099, 1999, doi 10.1137/S1052623496300507 (bounds). Factors 2 and 1/2 as in the documentation of
//   MATLAB's patternsearch.
// Deviations and choices:
// - `complete` 0 polls one point after the other and moves at the first success, starting with the direction that
//   succeeded last; 1 evaluates all directions and takes the best.
// - A poll point outside the box is moved onto the bound; it is skipped if the current point is on that bound already.
// - Restart from a uniform random point when h < `tolerance`, or when a poll around a diverged point failed.
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

extern const SolverEntry solver_pattern_search;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"mesh", 0.25, 1e-9, 1.0, "initial mesh size as a fraction of the range"},
    {"tolerance", 1e-9, 1e-15, 0.1, "mesh size at which the search is restarted"},
    {"expand", 2.0, 1.0, 10.0, "factor of the mesh size after a success"},
    {"contract", 0.5, 0.01, 0.99, "factor of the mesh size after a poll without success"},
    {"complete", 0.0, 0.0, 1.0, "0 move at the first better point, 1 evaluate the whole poll"},
};

class PatternSearch final : public support::SamplingSolver {
 public:
  explicit PatternSearch(const Problem& problem)
      : problem_(problem),
        first_mesh_(setting(problem, solver_pattern_search, "mesh")),
        tolerance_(setting(problem, solver_pattern_search, "tolerance")),
        expand_(setting(problem, solver_pattern_search, "expand")),
        contract_(setting(problem, solver_pattern_search, "contract")),
        complete_(support::whole_setting(problem, solver_pattern_search, "complete") == 1),
        restarts_(problem.stream.child("restarts")) {}

  [[nodiscard]] Ends ends() const override { return ends_; }

 protected:
  std::vector<Point> propose() override {
    if (starting_) {
      Draws draws(restarts_, starts_, 0);
      Point point = support::random_point(draws, problem_.dimension);
      if (starts_ == 0 && !problem_.start.empty()) point = support::clamped(problem_.start);
      return {point};
    }
    if (poll_.empty()) make_poll();
    if (complete_) return poll_;
    return {poll_[next_]};
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (starting_) {
      starting_ = false;
      ++starts_;
      centre_ = points[0];
      cost_ = cost[0];
      mesh_ = first_mesh_;
      first_direction_ = 0;
      poll_.clear();
      return;
    }
    const std::size_t best = support::argmin(cost);
    if (cost[best] < cost_) {
      first_direction_ = direction_[complete_ ? best : next_];
      centre_ = points[best];
      cost_ = cost[best];
      mesh_ = std::min(1.0, expand_ * mesh_);
      poll_.clear();
      return;
    }
    if (!complete_ && ++next_ < poll_.size()) return;
    mesh_ *= contract_;
    poll_.clear();
    starting_ = mesh_ < tolerance_ || cost_ >= diverged_cost;
    if (starting_) ends_.add(cost_);
  }

 private:
  void make_poll() {
    direction_.clear();
    next_ = 0;
    const std::size_t directions = 2 * problem_.dimension;
    for (std::size_t step = 0; step < directions; ++step) {
      const std::size_t direction = (first_direction_ + step) % directions;
      const std::size_t d = direction / 2;
      Point point = centre_;
      point[d] = support::clamp_unit(point[d] + (direction % 2 == 0 ? mesh_ : -mesh_));
      if (std::fabs(point[d] - centre_[d]) <= 0.0) continue;
      poll_.push_back(std::move(point));
      direction_.push_back(direction);
    }
  }

  Problem problem_;
  double first_mesh_;
  double tolerance_;
  double expand_;
  double contract_;
  bool complete_;
  Stream restarts_;
  bool starting_ = true;
  std::uint64_t starts_ = 0;
  Ends ends_;
  Point centre_;
  double cost_ = 0.0;
  double mesh_ = 0.0;
  std::vector<Point> poll_;
  std::vector<std::size_t> direction_;
  std::size_t first_direction_ = 0;
  std::size_t next_ = 0;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_pattern_search);
  return std::make_unique<PatternSearch>(problem);
}

}  // namespace

const SolverEntry solver_pattern_search = {
    "pattern-search",
    "Generalised pattern search with restarts",
    "Torczon, SIAM J. Optim. 7:1-25, 1997, doi 10.1137/S1052623493250780; Lewis & Torczon, SIAM J. Optim. "
    "9:1082-1099,\n"
    "1999, doi 10.1137/S1052623496300507",
    "Coordinate directions, mesh doubled after a success and halved after a failed poll, first better point accepted.\n"
    "Restarted from a uniform random point when the mesh is below its tolerance.",
    false,
    settings,
    make,
};

}  // namespace hysteron
