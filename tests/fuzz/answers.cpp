// Lines of JSON that a solver or an objective of the user's own prints, and the command it is started by.
#include "external/answers.hpp"

#include <algorithm>

#include "external/cost_range.hpp"
#include "external/line_program.hpp"
#include "fit/solver.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::string line(fuzz::text_of(data, size));
  constexpr std::size_t dimension = 2;
  fuzz::taken<WorkError>([&] {
    const SolverAnswer answer = solver_answer(line, "own", dimension);
    fuzz::require(answer.stop.empty() == !answer.points.empty(), "points or an end");
    fuzz::require(answer.points.size() % dimension == 0, "points are whole");
    fuzz::require(std::ranges::all_of(answer.points, [](double x) { return x >= 0.0 && x <= 1.0; }),
                  "coordinates are from 0 to 1");
  });
  fuzz::taken<WorkError>([&] {
    const std::vector<std::optional<double>> costs = objective_answer(line, dimension);
    fuzz::require(costs.size() == dimension, "every point has an answer");
    CostRange range;
    fuzz::require(std::ranges::all_of(costs, [&](const auto& c) { return !c || range.told(*c) < diverged_cost; }),
                  "costs are below that of a diverged point");
  });
  fuzz::taken([&] { fuzz::require(!words_of_command(line).front().empty(), "a command has a program"); });
  return 0;
}
