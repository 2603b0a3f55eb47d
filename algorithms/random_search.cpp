// Random search: uniform points in the box, the best is kept.
//
//   x_k ~ U(0, 1)^n, k = 1, 2, ...
//
// Source: S. H. Brooks, Oper. Res. 6(2):244-251, 1958, doi 10.1287/opre.6.2.244. The yardstick of a comparison: the
// share p of the box that is good enough is met after 1/p points on average, whatever the cost looks like elsewhere. A
// solver that ends above it at the same budget does harm.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_random_search;

namespace {

constexpr std::size_t batch = 64;

class RandomSearch final : public support::SamplingSolver {
 public:
  explicit RandomSearch(const Problem& problem) : problem_(problem), points_(problem.stream.child("positions")) {}

 protected:
  std::vector<support::Point> propose() override {
    std::vector<support::Point> points = support::random_population(problem_, points_, generation_, batch);
    problem_.start.clear();
    ++generation_;
    return points;
  }
  void accept(const std::vector<support::Point>& /*points*/, const std::vector<double>& /*cost*/) override {}

 private:
  Problem problem_;
  Stream points_;
  std::uint64_t generation_ = 0;
};

}  // namespace

const SolverEntry solver_random_search = {
    "random-search",
    "Uniform random search",
    "Brooks, Oper. Res. 6(2):244-251, 1958, doi 10.1287/opre.6.2.244",
    "Uniform points in the box, the start first. The yardstick: at the same budget a solver should end below it.",
    false,
    {},
    [](const Problem& problem) -> std::unique_ptr<Solver> {
      support::check_problem(problem, solver_random_search);
      return std::make_unique<RandomSearch>(problem);
    },
};

}  // namespace hysteron
