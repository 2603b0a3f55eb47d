#include "pagmo_peers.hpp"

#include <algorithm>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <string_view>
#include <utility>

namespace {

// A pagmo problem on somebody else's objective; copies share it.
struct BoxProblem {
  const hysteron::peers::ScalarObjective* objective = nullptr;
  std::size_t dimension = 0;

  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& x) const { return {(*objective)(x.data())}; }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimension, 0.0), pagmo::vector_double(dimension, 1.0)};
  }
};

}  // namespace

extern "C" [[gnu::visibility("default")]] void hysteron_run_pagmo(const char* algorithm, std::size_t dimension,
                                                                  std::size_t budget, std::uint32_t seed,
                                                                  const hysteron::peers::ScalarObjective& objective) {
  const std::string_view name(algorithm);
  const std::size_t individuals = name == "cmaes" ? 20 : 50;
  const auto generations = static_cast<unsigned>(std::max<std::size_t>(1, budget / individuals));
  const pagmo::problem problem(BoxProblem{&objective, dimension});
  const pagmo::population population(problem, individuals, seed);
  if (name == "cmaes") {
    // Defaults but for the last but one: candidates outside the box are put back on it.
    pagmo::cmaes method(generations, -1.0, -1.0, -1.0, -1.0, 0.5, 1e-6, 1e-6, false, true, seed);
    pagmo::algorithm(method).evolve(population);
  } else if (name == "pso") {
    pagmo::algorithm(pagmo::pso(generations, 0.7298, 2.05, 2.05, 0.5, 5u, 2u, 4u, false, seed)).evolve(population);
  } else {
    pagmo::algorithm(pagmo::de(generations, 0.8, 0.9, 2u, 1e-6, 1e-6, seed)).evolve(population);
  }
}
