// Memetic particle swarm: the constricted swarm explores, Levenberg-Marquardt descends from what it finds.
//
//   swarm    v <- chi ( v + u1 phi/2 (p - x) + u2 phi/2 (g - x) ),  x <- x + v,   phi = 4.1, chi = 0.72984
//   descent  every `period` generations at most `steps` bounded Levenberg-Marquardt points from the best memory that no
//            descent has finished at; the best point seen becomes that particle's memory and position
//
// The descent is that of support/descent.hpp (exact derivatives, affine coordinates projected out). A point of it costs
// 1 + d evaluations, so a descent is begun only while that much of the budget is left.
// Sources: M. Clerc, J. Kennedy, IEEE Trans. Evol. Comput. 6(1):58-73, 2002, doi 10.1109/4235.985692 (swarm);
//   D. W. Marquardt 1963, doi 10.1137/0111030 (descent). That a descent's result is written back into the population
//   ("Lamarckian") and that only the best memory descends are choices made here; the literature has many variants.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/support/constriction.hpp"
#include "algorithms/support/descent.hpp"
#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_pso_lm;

namespace {

using support::Draws;
using support::Point;

constexpr double phi = 4.1;

constexpr support::PopulationRule population{.usual = 24};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "particles in the swarm; 0: 24, at most budget / 10"},
    {"period", 5.0, 1.0, 1e6, "generations between two descents"},
    {"steps", 12.0, 1.0, 1e6, "points of a descent; an unfinished one goes on later if it is still the best"},
};

class MemeticSwarm final : public Solver {
 public:
  explicit MemeticSwarm(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_pso_lm, population)),
        period_(support::whole_setting(problem, solver_pso_lm, "period")),
        steps_(support::whole_setting(problem, solver_pso_lm, "steps")),
        moves_(problem.stream.child("moves")) {
    position_ = support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    const Stream start = problem.stream.child("velocities");
    for (std::size_t i = 0; i < count_; ++i) {
      Draws draws(start, 0, i);
      Point velocity(problem_.dimension);
      for (double& component : velocity) component = draws.uniform(-1.0, 1.0);
      velocity_.push_back(std::move(velocity));
    }
  }

  Request ask() override {
    Request request;
    if (!stopped_.empty()) return request;
    if (descent_) {
      request.derivatives = true;
      request.points.assign(descent_->next().begin(), descent_->next().end());
      return request;
    }
    for (const Point& point : position_) request.points.insert(request.points.end(), point.begin(), point.end());
    return request;
  }

  void tell(const Request& request, const Response& response) override {
    const std::size_t asked = descent_ ? 1 : count_;
    if (!stopped_.empty()) return;
    if (response.cost.size() < asked) {
      stopped_ = "points evaluated " + std::to_string(response.cost.size()) + " < points asked " +
                 std::to_string(asked) + ": budget used";
      return;
    }
    if (descent_) {
      descended(request, response);
    } else {
      swarmed(response);
    }
  }

  [[nodiscard]] std::string stopped_because() const override { return stopped_; }

 private:
  void swarmed(const Response& response) {
    used_ += count_;
    for (std::size_t i = 0; i < count_; ++i) {
      const double cost = support::ordered_cost(response.cost[i]);
      if (generation_ == 0) {
        best_.push_back(position_[i]);
        best_cost_.push_back(cost);
        exhausted_.push_back(false);
      } else if (cost < best_cost_[i]) {
        best_[i] = position_[i];
        best_cost_[i] = cost;
        exhausted_[i] = false;
      }
    }
    ++generation_;
    move();
    if (generation_ % period_ == 0) begin_descent();
  }

  void begin_descent() {
    if (problem_.budget - used_ < 1 + problem_.dimension) return;
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < count_; ++i) {
      if (exhausted_[i] || best_cost_[i] >= diverged_cost) continue;
      if (!chosen || best_cost_[i] < best_cost_[*chosen]) chosen = i;
    }
    if (!chosen) return;
    particle_ = *chosen;
    points_ = 0;
    descent_.emplace(
        Eigen::Map<const Eigen::VectorXd>(best_[particle_].data(), static_cast<Eigen::Index>(problem_.dimension)),
        problem_.linear);
  }

  void descended(const Request& request, const Response& response) {
    const auto d = static_cast<Eigen::Index>(problem_.dimension);
    used_ += 1 + problem_.dimension;
    ++points_;
    const double cost = support::ordered_cost(response.cost[0]);
    if (cost < best_cost_[particle_]) {
      best_cost_[particle_] = cost;
      best_[particle_].assign(request.points.begin(), request.points.begin() + d);
      position_[particle_] = best_[particle_];
    }
    descent_->tell(response.cost[0], response.cost[0] >= diverged_cost,
                   Eigen::Map<const Eigen::VectorXd>(response.gradient.data(), d),
                   Eigen::Map<const Eigen::MatrixXd>(response.gauss_newton.data(), d, d));
    if (descent_->finished()) exhausted_[particle_] = true;
    const bool affordable = problem_.budget >= used_ + 1 + problem_.dimension;
    if (descent_->finished() || points_ >= steps_ || !affordable) descent_.reset();
  }

  void move() {
    const double chi = support::constriction_coefficient(phi, 1.0);
    const std::size_t leader = support::argmin(best_cost_);
    for (std::size_t i = 0; i < count_; ++i) {
      Draws draws(moves_, generation_, i);
      for (std::size_t d = 0; d < problem_.dimension; ++d) {
        const double own_weight = 0.5 * phi * draws.uniform();
        const double leader_weight = 0.5 * phi * draws.uniform();
        const support::ParticleState next = support::constricted_move(
            {position_[i][d], velocity_[i][d]}, best_[i][d], best_[leader][d], own_weight, leader_weight, chi, 1.0);
        const bool outside = next.position < 0.0 || next.position > 1.0;
        position_[i][d] = support::clamp_unit(next.position);
        velocity_[i][d] = outside ? 0.0 : next.velocity;
      }
    }
  }

  Problem problem_;
  std::size_t count_;
  std::size_t period_;
  std::size_t steps_;
  Stream moves_;
  std::uint64_t generation_ = 0;
  std::size_t used_ = 0;
  std::vector<Point> position_;
  std::vector<Point> velocity_;
  std::vector<Point> best_;
  std::vector<double> best_cost_;
  std::vector<bool> exhausted_;  // a descent has finished at this memory
  std::optional<Descent> descent_;
  std::size_t particle_ = 0;
  std::size_t points_ = 0;
  std::string stopped_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_pso_lm);
  return std::make_unique<MemeticSwarm>(problem);
}

}  // namespace

const SolverEntry solver_pso_lm = {
    "pso-lm",
    "Particle swarm with Levenberg-Marquardt descents",
    "Clerc & Kennedy 2002, doi 10.1109/4235.985692; Marquardt 1963, doi 10.1137/0111030",
    "A constricted swarm whose best memory is improved by a few bounded Levenberg-Marquardt points every few\n"
    "generations; the result goes back into the swarm. Points of a descent cost 1 + d evaluations, those of the swarm "
    "1.",
    true,
    settings,
    make,
};

}  // namespace hysteron
