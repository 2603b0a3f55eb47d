// Single-objective algorithms of the pagmo2 library as pagmo:NAME, with the names of the library. Built where pagmo2 is
// installed (HYSTERON_PAGMO), else the family is not there.
//
//   minimise cost(u) over the unit box
//
// Source: F. Biscani, D. Izzo, J. Open Source Softw. 5(53):2338, 2020, doi 10.21105/joss.02338.
// What is done here and not by the library:
// - Generations are given without end, the program's own counter cuts the run off at the budget, wherever it is.
// - The first individual of a population is the problem's start, where there is one.
// - Not here: cmaes and xnes (their Eigen types have another memory layout under the instruction set this program is
// built
//   for, see bench/peers), and the wrappers of NLopt, which is a family of its own.
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/compass_search.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/gaco.hpp>
#include <pagmo/algorithms/gwo.hpp>
#include <pagmo/algorithms/ihs.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sea.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/algorithms/simulated_annealing.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/threading.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/support/rendezvous.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_pagmo;

namespace {

using support::ForeignSolver;
using support::Point;

constexpr Setting settings[] = {
    {"population", 20.0, 7.0, 100000.0, "individuals"},
};

struct Abandoned {};

// The objective as the library sees it.
struct UnitBox {
  const ForeignSolver::Evaluate* evaluate = nullptr;
  std::size_t dimension = 1;
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    Point point(x);
    for (double& coordinate : point) coordinate = support::clamp_unit(coordinate);
    const std::optional<support::Answer> answer = (*evaluate)(std::move(point), false);
    if (!answer) throw Abandoned{};
    return {answer->cost};
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimension, 0.0), pagmo::vector_double(dimension, 1.0)};
  }
  [[nodiscard]] pagmo::thread_safety get_thread_safety() const { return pagmo::thread_safety::none; }
};

// One call of evolve; it is repeated until the budget is used or the algorithm evaluates nothing any more.
constexpr unsigned generations = 1000;

enum class Kind { bee_colony, compass_search, de, de1220, gaco, gwo, ihs, pso, sade, sea, sga, simulated_annealing };

struct Named {
  const char* id;
  const char* title;
};
constexpr Named names[] = {
    {"pagmo:bee_colony", "pagmo2: artificial bee colony"},
    {"pagmo:compass_search", "pagmo2: compass search"},
    {"pagmo:de", "pagmo2: differential evolution"},
    {"pagmo:de1220", "pagmo2: self-adaptive differential evolution that also adapts its variant (pDE)"},
    {"pagmo:gaco", "pagmo2: extended ant colony optimisation"},
    {"pagmo:gwo", "pagmo2: grey wolf optimiser"},
    {"pagmo:ihs", "pagmo2: improved harmony search"},
    {"pagmo:pso", "pagmo2: particle swarm"},
    {"pagmo:sade", "pagmo2: self-adaptive differential evolution"},
    {"pagmo:sea", "pagmo2: simple (N+1) evolutionary algorithm"},
    {"pagmo:sga", "pagmo2: simple genetic algorithm"},
    {"pagmo:simulated_annealing", "pagmo2: simulated annealing (Corana)"},
};

pagmo::algorithm algorithm_of(Kind kind, const Problem& problem, unsigned seed) {
  const auto budget = static_cast<unsigned>(std::min<std::size_t>(problem.budget, 1000000000U));
  switch (kind) {
    case Kind::bee_colony:
      return pagmo::algorithm(pagmo::bee_colony(generations, 20U, seed));
    case Kind::compass_search:
      return pagmo::algorithm(pagmo::compass_search(budget, 0.1, 1e-9, 0.5));
    case Kind::de:
      return pagmo::algorithm(pagmo::de(generations, 0.8, 0.9, 2U, 1e-12, 1e-12, seed));
    case Kind::de1220: {
      return pagmo::algorithm(
          pagmo::de1220(generations, pagmo::de1220_statics<void>::allowed_variants, 1U, 1e-12, 1e-12, false, seed));
    }
    case Kind::gaco:
      return pagmo::algorithm(pagmo::gaco(generations, 7U, 1.0, 0.0, 0.01, 1U, 7U, budget, budget, 0.0, false, seed));
    case Kind::gwo:
      return pagmo::algorithm(pagmo::gwo(generations, seed));
    case Kind::ihs:
      return pagmo::algorithm(pagmo::ihs(budget, 0.85, 0.35, 0.99, 1e-5, 1.0, seed));
    case Kind::pso:
      return pagmo::algorithm(pagmo::pso(generations, 0.7298, 2.05, 2.05, 0.5, 5U, 2U, 4U, false, seed));
    case Kind::sade:
      return pagmo::algorithm(pagmo::sade(generations, 2U, 1U, 1e-12, 1e-12, false, seed));
    case Kind::sea:
      return pagmo::algorithm(pagmo::sea(budget, seed));
    case Kind::sga:
      return pagmo::algorithm(
          pagmo::sga(generations, 0.9, 1.0, 0.02, 1.0, 2U, "exponential", "polynomial", "tournament", seed));
    case Kind::simulated_annealing:
      return pagmo::algorithm(pagmo::simulated_annealing(10.0, 0.1, 10U, 10U, 10U, 1.0, seed));
  }
  return {};
}

std::string optimise(Kind kind, const Problem& problem, const ForeignSolver::Evaluate& evaluate) {
  const auto seed = static_cast<unsigned>(problem.stream.below(0x7fffffffU, 0));
  const auto size = support::whole_setting(problem, solver_pagmo, "population");
  try {
    pagmo::algorithm algorithm = algorithm_of(kind, problem, seed);
    pagmo::population population(pagmo::problem(UnitBox{&evaluate, problem.dimension}), 0U, seed + 1U);
    if (!problem.start.empty()) population.push_back(support::clamped(problem.start));
    while (population.size() < size) population.push_back(population.random_decision_vector());
    while (true) {
      const auto before = population.get_problem().get_fevals();
      population = algorithm.evolve(population);
      if (population.get_problem().get_fevals() == before) {
        return "pagmo: the algorithm evaluates nothing any more (its own tolerances are met)";
      }
    }
  } catch (const Abandoned&) {
    return "abandoned";
  } catch (const std::exception& error) {
    return "pagmo: " + std::string(error.what());
  }
}

template <int A>
std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_pagmo);
  return std::make_unique<ForeignSolver>(
      [problem](const ForeignSolver::Evaluate& evaluate) { return optimise(static_cast<Kind>(A), problem, evaluate); });
}

struct Algorithms {
  std::vector<SolverEntry> entries;
  std::vector<const SolverEntry*> rows;
  template <int... A>
  explicit Algorithms(std::integer_sequence<int, A...> /*all*/)
      : entries{SolverEntry{names[A].id, names[A].title, solver_pagmo.reference, solver_pagmo.description, false,
                            settings, &make<A>}...} {
    for (const SolverEntry& entry : entries) rows.push_back(&entry);
  }
};

std::span<const SolverEntry* const> members() {
  static const Algorithms algorithms(std::make_integer_sequence<int, static_cast<int>(std::size(names))>{});
  return algorithms.rows;
}

}  // namespace

const SolverEntry solver_pagmo = {
    "pagmo:*",
    "Algorithms of the pagmo2 library",
    "Biscani & Izzo, J. Open Source Softw. 5(53):2338, 2020, doi 10.21105/joss.02338",
    "Minimises the cost over the unit box with the library's own parameters, point by point; the first individual is "
    "the\n"
    "start given, the others are uniform. The budget is cut by the program's own counter. Built only where pagmo2 is\n"
    "installed.",
    false,
    settings,
    nullptr,
    members,
};

}  // namespace hysteron
