// Standard particle swarm optimisation 2011.
//
//   G = x + c (p + l - 2 x) / 3,  or  G = x + c (p - x) / 2 when the particle is its own best informant
//   x' a random point of the ball B(G, |G - x|):  direction a normalised Gaussian vector, radius U(0, |G - x|)
//   v <- w v + x' - x,   x <- x + v,   w = 1 / (2 ln 2), c = 1/2 + ln 2, S = 40, K = 3
//   confinement: coordinate on the bound, v = -v / 2 there
//
// Source: M. Clerc, Standard particle swarm optimisation, 2012, HAL hal-00764996; M. Zambrano-Bigiarini, M. Clerc,
//   R. Rojas, Proc. CEC 2013, pp. 2337-2344, doi 10.1109/CEC.2013.6557848.
// Deviations and choices:
// - `ball` 0 draws the radius uniformly, as in Clerc's program: the points crowd at the centre; 1 draws uniformly in
//   the volume.
// - Synchronous update; the informants are drawn anew after a generation that did not improve the best.
// - The particles are not permuted before the moves: with synchronous updates their order has no effect.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "algorithms/support/topology.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_spso_2011;

namespace {

using support::Draws;
using support::Point;

constexpr double inertia = 0.5 / std::numbers::ln2;
constexpr double acceleration = 0.5 + std::numbers::ln2;

constexpr support::PopulationRule population{.usual = 40, .generations = 100, .least = 10};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "particles in the swarm; 0: budget / 100, at least 10, at most 40"},
    {"informants", 3.0, 1.0, 1000.0, "particles informed by each particle (K), drawn with replacement"},
    {"ball", 0.0, 0.0, 1.0, "0 radius uniform, 1 uniform in the volume of the ball"},
};

class StandardSwarm final : public support::SamplingSolver {
 public:
  explicit StandardSwarm(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_spso_2011, population)),
        links_per_particle_(support::whole_setting(problem, solver_spso_2011, "informants")),
        volume_(support::whole_setting(problem, solver_spso_2011, "ball") == 1),
        moves_(problem.stream.child("moves")),
        links_(problem.stream.child("links")) {
    position_ = support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    const Stream velocities = problem.stream.child("velocities");
    for (std::size_t i = 0; i < count_; ++i) {
      Draws draws(velocities, 0, i);
      Point velocity(problem.dimension);
      for (std::size_t d = 0; d < velocity.size(); ++d) velocity[d] = draws.uniform() - position_[i][d];
      velocity_.push_back(std::move(velocity));
    }
    informants_ = support::random_neighbourhood(count_, links_per_particle_, links_, 0);
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ > 0) {
      for (std::size_t i = 0; i < count_; ++i) move(i);
    }
    return position_;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (generation_ == 0) {
      best_ = points;
      best_cost_ = cost;
    } else {
      const double before = best_cost_[support::argmin(best_cost_)];
      for (std::size_t i = 0; i < count_; ++i) {
        if (cost[i] < best_cost_[i]) {
          best_[i] = points[i];
          best_cost_[i] = cost[i];
        }
      }
      if (best_cost_[support::argmin(best_cost_)] >= before) {
        informants_ = support::random_neighbourhood(count_, links_per_particle_, links_, generation_);
      }
    }
    ++generation_;
  }

 private:
  void move(std::size_t i) {
    const std::size_t leader = support::best_informant(informants_[i], best_cost_);
    Point& x = position_[i];
    Point centre(x.size());
    for (std::size_t d = 0; d < x.size(); ++d) {
      centre[d] = leader == i ? x[d] + acceleration * (best_[i][d] - x[d]) / 2.0
                              : x[d] + acceleration * (best_[i][d] + best_[leader][d] - 2.0 * x[d]) / 3.0;
    }
    Draws draws(moves_, generation_, i);
    Point direction(x.size());
    double square = 0.0;
    for (double& component : direction) {
      component = draws.normal();
      square += component * component;
    }
    double share = draws.uniform();
    if (volume_) share = std::pow(share, 1.0 / static_cast<double>(x.size()));
    const double scale = square > 0.0 ? share * support::distance(centre, x) / std::sqrt(square) : 0.0;
    for (std::size_t d = 0; d < x.size(); ++d) {
      double& v = velocity_[i][d];
      v = inertia * v + centre[d] + scale * direction[d] - x[d];
      x[d] += v;
      if (x[d] < 0.0 || x[d] > 1.0) {
        x[d] = support::clamp_unit(x[d]);
        v *= -0.5;
      }
    }
  }

  Problem problem_;
  std::size_t count_;
  std::size_t links_per_particle_;
  bool volume_;
  Stream moves_;
  Stream links_;
  std::uint64_t generation_ = 0;
  std::vector<Point> position_;
  std::vector<Point> velocity_;
  std::vector<Point> best_;
  std::vector<double> best_cost_;
  support::Neighbourhood informants_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_spso_2011);
  return std::make_unique<StandardSwarm>(problem);
}

}  // namespace

const SolverEntry solver_spso_2011 = {
    "spso-2011",
    "Standard particle swarm 2011",
    "Clerc, Standard particle swarm optimisation, HAL hal-00764996, 2012; Zambrano-Bigiarini, Clerc & Rojas, CEC "
    "2013,\n"
    "doi 10.1109/CEC.2013.6557848",
    "Rotation-invariant move in a ball, adaptive random informants (K = 3), v = -v/2 on a bound.\n"
    "Synchronous update of the bests.",
    false,
    settings,
    make,
};

}  // namespace hysteron
