// Crow search against its published rules, computed here a second time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fit/solver.hpp"
#include "tests/algorithms/solver_harness.hpp"

namespace hysteron {
namespace {

constexpr std::size_t dimension = 3;
constexpr std::size_t crows = 20;
constexpr std::size_t budget = 400;

Problem published(std::uint64_t seed) {
  Problem problem;
  problem.dimension = dimension;
  problem.budget = budget;
  problem.stream = Stream(seed).child("crows");
  problem.linear.assign(dimension, false);
  problem.settings = {{"population", double{crows}}, {"awareness", 0.1}, {"flight", 2.0}, {"bounds", 0.0}};
  return problem;
}

using Point = std::vector<double>;

double cost_of(const Point& point) {
  double sum = 0.0;
  for (const double r : testing::sphere(point.data(), dimension).value) sum += r * r;
  return std::sqrt(sum);
}

// The points that the published rules evaluate, with the draws of the solver: position and memory of every crow, a move
// out of the box refused, the memory replaced by what is better.
std::vector<double> points_of_the_source(const Problem& problem, std::size_t& refused) {
  const Stream positions = problem.stream.child("positions");
  const Stream moves = problem.stream.child("moves");
  std::vector<Point> position(crows, Point(dimension));
  std::vector<double> asked;
  for (std::uint32_t i = 0; i < crows; ++i) {
    for (std::uint32_t d = 0; d < dimension; ++d) position[i][d] = positions.uniform(0, i, d);
    asked.insert(asked.end(), position[i].begin(), position[i].end());
  }
  std::vector<Point> memory = position;
  for (std::uint64_t generation = 1; asked.size() < budget * dimension; ++generation) {
    std::vector<Point> next = position;
    for (std::uint32_t i = 0; i < crows; ++i) {
      const Point& followed = memory[moves.below(crows, generation, i, 0)];
      const bool aware = moves.uniform(generation, i, 1) < 0.1;
      bool inside = true;
      for (std::uint32_t d = 0; d < dimension; ++d) {
        next[i][d] = aware ? moves.uniform(generation, i, 2 + d)
                           : position[i][d] + 2.0 * moves.uniform(generation, i, 2) * (followed[d] - position[i][d]);
        inside = inside && next[i][d] >= 0.0 && next[i][d] <= 1.0;
      }
      refused += inside ? 0 : 1;
      if (!inside) next[i] = position[i];
      if (next[i] != position[i]) asked.insert(asked.end(), next[i].begin(), next[i].end());
    }
    position = next;
    for (std::size_t i = 0; i < crows; ++i) {
      if (cost_of(position[i]) < cost_of(memory[i])) memory[i] = position[i];
    }
  }
  asked.resize(budget * dimension);
  return asked;
}

TEST(CrowSearch, WithTheSettingsOfTheSourceAsksForItsPoints) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::vector<double> asked;
    for (const testing::Exchange& exchange :
         testing::drive(*find_solver("crow-search"), published(seed), testing::sphere).exchanges) {
      asked.insert(asked.end(), exchange.request.points.begin(), exchange.request.points.end());
    }
    std::size_t refused = 0;
    const std::vector<double> expected = points_of_the_source(published(seed), refused);
    ASSERT_EQ(asked.size(), expected.size());
    for (std::size_t k = 0; k < asked.size(); ++k) ASSERT_NEAR(asked[k], expected[k], 1e-12) << "number " << k;
    EXPECT_GT(refused, 10U) << "no crow would have left the box";
  }
}

TEST(CrowSearch, CutsMovesAtTheBoundWhereNothingIsSet) {
  Problem problem = published(1);
  problem.settings.clear();
  std::size_t on_the_bound = 0;
  for (const testing::Exchange& exchange :
       testing::drive(*find_solver("crow-search"), problem, testing::sphere).exchanges) {
    for (const double coordinate : exchange.request.points) {
      EXPECT_TRUE(coordinate >= 0.0 && coordinate <= 1.0) << coordinate;
      on_the_bound += coordinate == 0.0 || coordinate == 1.0 ? 1 : 0;
    }
  }
  EXPECT_GT(on_the_bound, 10U);
}

}  // namespace
}  // namespace hysteron
