// Adaptive charged system search: charged system search in a shrinking part of the box. AN APPROXIMATION.
//
//   For stage s = 1, 2, ...: charged system search (equations in css.cpp) with N particles for `generations` moves in
//   the box [lower, upper]; then upper - lower is multiplied by `shrink` and the box is centred on the best point,
//   shifted to stay in the unit box. When it is narrower than `smallest`, it becomes the whole box again.
//
// Source: S. Talatahari, A. Kaveh, N. Mohajer Rahbari, J. Mech. Sci. Technol. 26(8):2523-2534, 2012 (Bouc-Wen model of
//   magnetorheological dampers; charged system search with a "sub-optimization mechanism").
// Deviations and doubts: only the abstract was at hand. The mechanism is built from its description for structural
//   optimisation by the same group: the undesirable part of the search space is deleted after each stage and the rest
//   is searched more finely. Lengths, factors and the return to the whole box are choices made here. k_a and k_v
//   follow the progress of the stage, not of the whole run. The new population is uniform in the new box, except that
//   its first particles are the points of the charged memory, moved into the box. A return to the whole box is a fresh
//   start with an empty memory: the driver remembers the best point.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/charged_system.hpp"
#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_adaptive_css;

namespace {

using support::Draws;
using support::Point;

constexpr support::PopulationRule population{.usual = 20};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "charged particles; 0: 20, at most budget / 10"},
    {"generations", 20.0, 1.0, 1e6, "moves in one stage"},
    {"shrink", 0.7, 0.01, 0.99, "width of the box relative to the one before"},
    {"smallest", 1e-6, 1e-14, 0.5, "width at which the whole box is searched again"},
    {"radius", 0.1, 1e-9, 1e6, "radius a of the charged sphere, on the dimensionless separation"},
    {"attract", 1.0, 0.0, 1.0, "share of attracting forces, the others repel"},
    {"worse_attract", 0.0, 0.0, 1.0, "1 some of the worse attract the better, 0 none do"},
};

class AdaptiveChargedSystem final : public support::SamplingSolver {
 public:
  explicit AdaptiveChargedSystem(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_adaptive_css, population)),
        stage_length_(support::whole_setting(problem, solver_adaptive_css, "generations")),
        shrink_(setting(problem, solver_adaptive_css, "shrink")),
        smallest_(setting(problem, solver_adaptive_css, "smallest")),
        moves_(problem.stream.child("moves")),
        stages_(problem.stream.child("stages")),
        lower_(problem.dimension, 0.0),
        upper_(problem.dimension, 1.0) {
    options_.radius = setting(problem, solver_adaptive_css, "radius");
    options_.attract = setting(problem, solver_adaptive_css, "attract");
    options_.worse_attract = support::whole_setting(problem, solver_adaptive_css, "worse_attract") == 1;
    options_.memory_size = std::max<std::size_t>(1, count_ / 4);
    system_.configure(options_);
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ == 0) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    }
    if (in_stage_ == 0) return stage_population();
    const double progress = static_cast<double>(in_stage_) / static_cast<double>(stage_length_);
    return system_.moved(moves_, generation_, std::min(1.0, progress), lower_, upper_);
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (in_stage_ == 0) {
      system_.place(points, cost);
    } else {
      system_.accept(points, cost);
    }
    ++generation_;
    ++in_stage_;
    if (in_stage_ > stage_length_) {
      next_box();
      in_stage_ = 0;
    }
  }

 private:
  void next_box() {
    if (system_.best_cost() >= diverged_cost) return;  // nothing to shrink around
    width_ *= shrink_;
    whole_ = width_ < smallest_;
    if (whole_) {
      width_ = 1.0;
      system_ = support::ChargedSystem();
      system_.configure(options_);
      std::fill(lower_.begin(), lower_.end(), 0.0);
      std::fill(upper_.begin(), upper_.end(), 1.0);
      return;
    }
    for (std::size_t d = 0; d < lower_.size(); ++d) {
      lower_[d] = std::clamp(system_.best()[d] - 0.5 * width_, 0.0, 1.0 - width_);
      upper_[d] = lower_[d] + width_;
    }
  }

  std::vector<Point> stage_population() const {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count_; ++i) {
      Draws draws(stages_, generation_, i);
      Point point(problem_.dimension);
      for (std::size_t d = 0; d < point.size(); ++d) point[d] = draws.uniform(lower_[d], upper_[d]);
      if (!whole_ && i < system_.memory().size()) {
        for (std::size_t d = 0; d < point.size(); ++d) {
          point[d] = std::clamp(system_.memory()[i][d], lower_[d], upper_[d]);
        }
      }
      points.push_back(support::clamped(std::move(point)));
    }
    return points;
  }

  Problem problem_;
  std::size_t count_;
  std::size_t stage_length_;
  double shrink_;
  double smallest_;
  Stream moves_;
  Stream stages_;
  Point lower_;
  Point upper_;
  double width_ = 1.0;
  bool whole_ = true;
  std::uint64_t generation_ = 0;
  std::size_t in_stage_ = 0;
  support::ChargedSettings options_;
  support::ChargedSystem system_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_adaptive_css);
  return std::make_unique<AdaptiveChargedSystem>(problem);
}

}  // namespace

const SolverEntry solver_adaptive_css = {
    "adaptive-css",
    "Adaptive charged system search (approximation)",
    "Talatahari, Kaveh & Mohajer Rahbari, J. Mech. Sci. Technol. 26(8):2523-2534, 2012",
    "Charged system search in stages, each in a smaller box around the best point. The published sub-optimization\n"
    "mechanism was not available in full: stage length, shrinking factor and restart are choices made here.",
    false,
    settings,
    make,
};

}  // namespace hysteron
