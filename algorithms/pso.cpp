// Particle swarm with constriction coefficient.
//
//   v <- chi ( v + u1 phi/2 (p - x) + u2 phi/2 (l - x) ),   x <- x + v,   u1, u2 ~ U(0,1) afresh per coordinate
//   chi = 2 k / |2 - phi - sqrt(phi^2 - 4 phi)|,   phi = 4.1, k = 1: chi = 0.72984
//
// p is the best point of the particle, l the best point among its informants.
// Source: M. Clerc, J. Kennedy, IEEE Trans. Evol. Comput. 6(1):58-73, 2002, doi 10.1109/4235.985692 (update and chi);
//   R. C. Eberhart, Y. Shi, Proc. CEC 2000, pp. 84-88, doi 10.1109/CEC.2000.870279 (|v| limited to the range).
// Deviations and choices:
// - Synchronous: all particles move, then all bests are updated, so that a generation can be evaluated in parallel.
// - Bounds, which the source leaves open: `bounds` 0 absorbs (coordinate on the bound, its velocity 0), 1 reflects
//   (coordinate mirrored, its velocity reversed).
// - Initial velocities U(-vmax, vmax). No stopping rule but the budget; a collapsed swarm is not restarted.
// - The source speaks of one informant set, the whole swarm, and of no population. Defaults led on training problems
//   (results/defaults.md): the von Neumann torus (Kennedy & Mendes, Proc. CEC 2002, pp. 1671-1676), a hundredth of the
//   budget as particles, |v| limited to a fifth of the range. Ring and adaptive random (K = 3, redrawn after a
//   generation that did not improve the best) are the other usual choices; topology 0 and vmax 1 are the sources'.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/constriction.hpp"
#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "algorithms/support/topology.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_pso;

namespace {

using support::Draws;
using support::Point;

constexpr support::PopulationRule population{.usual = 40, .generations = 100, .least = 10};
constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "particles in the swarm; 0: budget / 100, at least 10, at most 40"},
    {"phi", 4.1, 4.0, 100.0, "sum of the two acceleration coefficients"},
    {"k", 1.0, 0.01, 1.0, "scale of the constriction coefficient"},
    {"vmax", 0.2, 1e-6, 100.0, "velocity limit as a fraction of the range"},
    {"topology", 2.0, 0.0, 3.0, "0 whole swarm, 1 ring, 2 von Neumann, 3 adaptive random (K = 3)"},
    {"bounds", 0.0, 0.0, 1.0, "0 absorb: on the bound with velocity 0, 1 reflect"},
};

class ParticleSwarm final : public support::SamplingSolver {
 public:
  explicit ParticleSwarm(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_pso, population)),
        topology_(support::whole_setting(problem, solver_pso, "topology")),
        reflect_(support::whole_setting(problem, solver_pso, "bounds") == 1),
        phi_(setting(problem, solver_pso, "phi")),
        chi_(support::constriction_coefficient(phi_, setting(problem, solver_pso, "k"))),
        speed_limit_(setting(problem, solver_pso, "vmax")),
        moves_(problem.stream.child("moves")),
        links_(problem.stream.child("links")) {
    const Stream start = problem.stream.child("velocities");
    position_ = support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    for (std::size_t i = 0; i < count_; ++i) {
      Draws draws(start, 0, i);
      Point velocity(problem_.dimension);
      for (double& component : velocity) component = draws.uniform(-speed_limit_, speed_limit_);
      velocity_.push_back(std::move(velocity));
    }
    if (topology_ == 1) informants_ = support::ring_neighbourhood(count_);
    if (topology_ == 2) informants_ = support::von_neumann_neighbourhood(count_);
    if (topology_ == 3) informants_ = support::random_neighbourhood(count_, 3, links_, 0);
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ > 0) move();
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
      const bool improved = best_cost_[support::argmin(best_cost_)] < before;
      if (topology_ == 3 && !improved) {
        informants_ = support::random_neighbourhood(count_, 3, links_, generation_);
      }
    }
    ++generation_;
  }

 private:
  void move() {
    const std::size_t swarm_best = support::argmin(best_cost_);
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t leader = topology_ == 0 ? swarm_best : support::best_informant(informants_[i], best_cost_);
      Draws draws(moves_, generation_, i);
      for (std::size_t d = 0; d < problem_.dimension; ++d) {
        const double own_weight = 0.5 * phi_ * draws.uniform();
        const double informant_weight = 0.5 * phi_ * draws.uniform();
        const support::ParticleState next =
            support::constricted_move({position_[i][d], velocity_[i][d]}, best_[i][d], best_[leader][d], own_weight,
                                      informant_weight, chi_, speed_limit_);
        position_[i][d] = next.position;
        velocity_[i][d] = next.velocity;
        if (next.position < 0.0 || next.position > 1.0) {
          position_[i][d] = reflect_ ? support::mirror_unit(next.position) : support::clamp_unit(next.position);
          velocity_[i][d] = reflect_ ? -next.velocity : 0.0;
        }
      }
    }
  }

  Problem problem_;
  std::size_t count_;
  std::size_t topology_;
  bool reflect_;
  double phi_;
  double chi_;
  double speed_limit_;
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
  support::check_problem(problem, solver_pso);
  return std::make_unique<ParticleSwarm>(problem);
}

}  // namespace

const SolverEntry solver_pso = {
    "pso",
    "Particle swarm with constriction",
    "Clerc & Kennedy, IEEE Trans. Evol. Comput. 6(1):58-73, 2002, doi 10.1109/4235.985692",
    "Constriction coefficient from phi and k (0.72984 for 4.1 and 1), velocity limited to a fifth of the range, "
    "informants\n"
    "on a von Neumann torus by default. Synchronous update of the bests; a coordinate that leaves the\n"
    "box is put on the bound with velocity 0.",
    false,
    settings,
    make,
};

}  // namespace hysteron
