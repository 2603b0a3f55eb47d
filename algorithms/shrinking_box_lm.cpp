// Levenberg-Marquardt in a box that shrinks step by step around the best point.
//
//   stage k: descents from the best point and from random points of the box B_k
//   B_(k+1) = B_0 and [best - w/2, best + w/2] where w = shrink^(k+1) times the side of B_0
//
// Source: the gradually shrinking boundaries of the identification of a damper's Bouc-Wen model by least squares
// (2023), which names the method and not its schedule: factor, descents a stage and the random starts beside the best
// point are choices made here. That study also fixes n and x0 to their means over the currents between its two stages;
// that is a matter of the parameters, `--fix`, and not of this solver. The descent is that of support/descent.hpp in
// coordinates of B_k.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/support/descent.hpp"
#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_shrinking_box_lm;

namespace {

using support::Point;

constexpr Setting settings[] = {
    {"starts", 0.0, 0.0, 1024.0,
     "descents a stage, the first from the best point; 0: 4, at most what the budget has room for"},
    {"steps", 25.0, 1.0, 1e6, "points of a descent at most"},
    {"shrink", 0.5, 0.01, 0.99, "side of a stage's box over that of the stage before"},
    {"smallest", 0.001, 1e-9, 0.5, "side of the box, as a share of the whole, at which the solver ends"},
};

class ShrinkingBox final : public Solver {
 public:
  explicit ShrinkingBox(const Problem& problem)
      : problem_(problem),
        steps_(support::whole_setting(problem, solver_shrinking_box_lm, "steps")),
        starts_(starts_of(problem, steps_)),
        shrink_(setting(problem, solver_shrinking_box_lm, "shrink")),
        smallest_(setting(problem, solver_shrinking_box_lm, "smallest")),
        lower_(problem.dimension, 0.0),
        upper_(problem.dimension, 1.0) {
    Point first(problem.dimension, 0.5);
    if (!problem.start.empty()) first = support::clamped(problem.start);
    begin(first);
  }

  Request ask() override {
    Request request;
    request.derivatives = true;
    if (!stopped_.empty()) return request;
    for (const std::size_t k : active_) {
      const Point point = outside(descents_[k].next());
      request.points.insert(request.points.end(), point.begin(), point.end());
    }
    return request;
  }

  void tell(const Request& request, const Response& response) override {
    if (!stopped_.empty()) return;
    const std::size_t d = problem_.dimension;
    if (response.cost.size() < active_.size()) {
      stopped_ = "points evaluated " + std::to_string(response.cost.size()) + " < points asked " +
                 std::to_string(active_.size()) + ": budget used";
      return;
    }
    const Eigen::Map<const Eigen::VectorXd> low(lower_.data(), static_cast<Eigen::Index>(d));
    const Eigen::Map<const Eigen::VectorXd> high(upper_.data(), static_cast<Eigen::Index>(d));
    const Eigen::VectorXd side = high - low;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      const double cost = support::ordered_cost(response.cost[i]);
      if (cost < best_cost_) {
        best_cost_ = cost;
        const auto row = request.points.begin() + static_cast<std::ptrdiff_t>(i * d);
        best_.assign(row, row + static_cast<std::ptrdiff_t>(d));
      }
      const auto n = static_cast<Eigen::Index>(d);
      const Eigen::Map<const Eigen::VectorXd> gradient(response.gradient.data() + i * d, n);
      const Eigen::Map<const Eigen::MatrixXd> matrix(response.gauss_newton.data() + i * d * d, n, n);
      descents_[active_[i]].tell(response.cost[i], response.cost[i] >= diverged_cost,
                                 side.cwiseProduct(gradient).eval(),
                                 (side.asDiagonal() * matrix * side.asDiagonal()).eval());
    }
    ++points_;
    std::erase_if(active_, [&](std::size_t k) { return descents_[k].finished(); });
    if (active_.empty() || points_ >= steps_) next_stage();
  }

  [[nodiscard]] std::string stopped_because() const override { return stopped_; }

 private:
  // No more at once than the budget holds to their end; a point with its derivatives counts as 1 + dimension
  // evaluations.
  static std::size_t starts_of(const Problem& problem, std::size_t steps) {
    constexpr std::size_t usual = 4;
    const std::size_t set = support::whole_setting(problem, solver_shrinking_box_lm, "starts");
    if (set > 0 || problem.budget == 0) return set > 0 ? set : usual;
    const std::size_t a_descent = steps * (1 + problem.dimension);
    return std::clamp<std::size_t>(problem.budget / a_descent, 1, usual);
  }

  void next_stage() {
    ++stage_;
    if (best_cost_ < diverged_cost) {
      side_ *= shrink_;
      if (side_ < smallest_) {
        stopped_ = "side of the box < " + support::number_text(smallest_) + " of the whole";
        return;
      }
      for (std::size_t d = 0; d < problem_.dimension; ++d) {
        lower_[d] = std::max(0.0, best_[d] - 0.5 * side_);
        upper_[d] = std::min(1.0, best_[d] + 0.5 * side_);
      }
    }
    begin(best_cost_ < diverged_cost ? best_ : random_point(0));
  }

  void begin(const Point& first) {
    descents_.clear();
    active_.clear();
    points_ = 0;
    for (std::size_t k = 0; k < starts_; ++k) {
      descents_.emplace_back(inside(k == 0 ? first : random_point(k)), problem_.linear);
      active_.push_back(k);
    }
  }

  Point random_point(std::size_t k) const {
    support::Draws draws(problem_.stream, stage_, k);
    Point point(problem_.dimension);
    for (std::size_t d = 0; d < point.size(); ++d) point[d] = draws.uniform(lower_[d], upper_[d]);
    return point;
  }

  // From coordinates of the whole box to those of the stage's box, and back.
  Eigen::VectorXd inside(const Point& point) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(point.size()));
    for (std::size_t d = 0; d < point.size(); ++d) {
      result[static_cast<Eigen::Index>(d)] = support::clamp_unit((point[d] - lower_[d]) / (upper_[d] - lower_[d]));
    }
    return result;
  }
  Point outside(const Eigen::VectorXd& point) const {
    Point result(problem_.dimension);
    for (std::size_t d = 0; d < result.size(); ++d) {
      result[d] = support::clamp_unit(lower_[d] + (upper_[d] - lower_[d]) * point[static_cast<Eigen::Index>(d)]);
    }
    return result;
  }

  Problem problem_;
  std::size_t steps_;
  std::size_t starts_;
  double shrink_;
  double smallest_;
  Point lower_;
  Point upper_;
  double side_ = 1.0;
  std::uint64_t stage_ = 0;
  std::size_t points_ = 0;
  std::vector<Descent> descents_;
  std::vector<std::size_t> active_;
  Point best_;
  double best_cost_ = 3.0 * diverged_cost;
  std::string stopped_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_shrinking_box_lm);
  return std::make_unique<ShrinkingBox>(problem);
}

}  // namespace

const SolverEntry solver_shrinking_box_lm = {
    "shrinking-box-lm",
    "Levenberg-Marquardt in a shrinking box",
    "identification of a damper's Bouc-Wen model by least squares with gradually shrinking boundaries, 2023",
    "Bounded descents from the best point and from random points of a box that halves around the best point stage by\n"
    "stage, until its side is 0.001 of the whole. The source names the method; the schedule is a choice made here.",
    true,
    settings,
    make,
};

}  // namespace hysteron
