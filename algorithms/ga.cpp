// Genetic algorithm after the documented defaults of MATLAB's ga for bounded real variables: AN APPROXIMATION.
//
//   N = 50 (<= 5 variables) or 200, at most budget / 10;  elite ceil(0.05 N);  crossover children
//   round(0.8 (N - elite)), the rest mutants;  expectation of the parent of rank r proportional to 1 / sqrt(r);
//   stochastic uniform selection: one random start, equal steps along the line of expectations;
//   scattered crossover: every gene from either parent with probability 1/2.
//
// Source: documentation of the Global Optimization Toolbox (gaoptimset, ga); rank scaling and stochastic universal
//   sampling: J. E. Baker, Proc. 2nd Int. Conf. Genetic Algorithms, 1987, pp. 14-21.
// Deviations and doubts:
// - mutationadaptfeasible is not public. Here: a mutant moves along a random unit vector by the step size, halved
//   until it lies in the box (at most 30 times, then clipped); the step starts at 1, is multiplied by 4 (up to 1)
//   after a generation that improved the best and divided by 4 (down to 1e-8) after one that did not.
// - While no individual has a finite cost the step stays at 1: there is nothing to refine.
// - N never exceeds budget / 10, so that small budgets still see ten generations.
// - The stall rule (50 generations) is not applied: the budget ends the run. Elites are not evaluated again.
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

extern const SolverEntry solver_ga;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "individuals; 0: 50 up to 5 variables, else 200, at most budget / 10"},
    {"elite_share", 0.05, 0.0, 0.5, "share of the population kept unchanged (rounded up)"},
    {"crossover_share", 0.8, 0.0, 1.0, "share of the children made by crossover, the rest by mutation"},
};

class GeneticAlgorithm final : public support::SamplingSolver {
 public:
  explicit GeneticAlgorithm(const Problem& problem)
      : problem_(problem),
        count_(support::population_size(problem, solver_ga, {.usual = problem.dimension <= 5 ? 50U : 200U})),
        selection_(problem.stream.child("selection")),
        children_(problem.stream.child("children")) {
    count_ = std::max<std::size_t>(count_, 4);
    const double n = static_cast<double>(count_);
    elite_ = static_cast<std::size_t>(std::ceil(setting(problem, solver_ga, "elite_share") * n));
    elite_ = std::min(elite_, count_ - 1);
    crossover_ = static_cast<std::size_t>(
        std::lround(setting(problem, solver_ga, "crossover_share") * static_cast<double>(count_ - elite_)));
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ == 0) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, count_);
    }
    const std::vector<std::size_t> parents = select(2 * crossover_ + (count_ - elite_ - crossover_));
    std::vector<Point> children;
    for (std::size_t i = 0; i < count_ - elite_; ++i) {
      Draws draws(children_, generation_, i);
      if (i < crossover_) {
        const Point& first = population_[parents[2 * i]];
        const Point& second = population_[parents[2 * i + 1]];
        Point child(problem_.dimension);
        for (std::size_t d = 0; d < child.size(); ++d) child[d] = draws.uniform() < 0.5 ? first[d] : second[d];
        children.push_back(std::move(child));
      } else {
        children.push_back(mutant(population_[parents[crossover_ + i]], draws));
      }
    }
    return children;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    std::vector<Point> pool;
    std::vector<double> pool_cost;
    if (generation_ > 0) {
      pool.assign(population_.begin(), population_.begin() + static_cast<std::ptrdiff_t>(elite_));
      pool_cost.assign(cost_.begin(), cost_.begin() + static_cast<std::ptrdiff_t>(elite_));
      const bool improved = cost[support::argmin(cost)] < cost_.front();
      if (cost_.front() < diverged_cost) {
        step_ = improved ? std::min(1.0, 4.0 * step_) : std::max(1e-8, step_ / 4.0);
      }
    }
    pool.insert(pool.end(), points.begin(), points.end());
    pool_cost.insert(pool_cost.end(), cost.begin(), cost.end());
    population_.clear();
    cost_.clear();
    for (const std::size_t i : support::ascending(pool_cost)) {
      population_.push_back(std::move(pool[i]));
      cost_.push_back(pool_cost[i]);
    }
    ++generation_;
  }

 private:
  // Parents by rank (the population is sorted), in random order so that mates are not neighbours in rank.
  std::vector<std::size_t> select(std::size_t wanted) const {
    std::vector<double> expectation(count_);
    double total = 0.0;
    for (std::size_t rank = 0; rank < count_; ++rank) {
      expectation[rank] = 1.0 / std::sqrt(static_cast<double>(rank + 1));
      total += expectation[rank];
    }
    Draws draws(selection_, generation_, 0);
    const double step = total / static_cast<double>(wanted);
    double pointer = step * draws.uniform();
    double upper = expectation[0];
    std::size_t rank = 0;
    std::vector<std::size_t> parents;
    for (std::size_t i = 0; i < wanted; ++i) {
      while (pointer > upper && rank + 1 < count_) upper += expectation[++rank];
      parents.push_back(rank);
      pointer += step;
    }
    support::shuffle(parents, draws);
    return parents;
  }

  Point mutant(const Point& parent, Draws& draws) const {
    Point direction(problem_.dimension);
    double square = 0.0;
    for (double& component : direction) {
      component = draws.normal();
      square += component * component;
    }
    const double norm = square > 0.0 ? std::sqrt(square) : 1.0;
    double length = step_ / norm;
    for (int halving = 0; halving < 30; ++halving) {
      bool inside = true;
      for (std::size_t d = 0; d < parent.size(); ++d) {
        const double coordinate = parent[d] + length * direction[d];
        inside = inside && coordinate >= 0.0 && coordinate <= 1.0;
      }
      if (inside) break;
      length *= 0.5;
    }
    Point child = parent;
    for (std::size_t d = 0; d < child.size(); ++d) {
      child[d] = support::clamp_unit(child[d] + length * direction[d]);
    }
    return child;
  }

  Problem problem_;
  std::size_t count_;
  std::size_t elite_ = 0;
  std::size_t crossover_ = 0;
  Stream selection_;
  Stream children_;
  std::uint64_t generation_ = 0;
  double step_ = 1.0;
  std::vector<Point> population_;  // sorted, best first
  std::vector<double> cost_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_ga);
  return std::make_unique<GeneticAlgorithm>(problem);
}

}  // namespace

const SolverEntry solver_ga = {
    "ga",
    "Genetic algorithm (approximation of MATLAB's defaults with bounds)",
    "MathWorks, Global Optimization Toolbox documentation, ga and gaoptimset",
    "Rank scaling, stochastic uniform selection, scattered crossover 0.8, 5 % elite. The adaptive feasible mutation\n"
    "is not public: the one here is an approximation (random direction, step adapted by success, kept in the box).\n"
    "Population at most a tenth of the budget; the budget alone ends the run.",
    false,
    settings,
    make,
};

}  // namespace hysteron
