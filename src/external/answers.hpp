// What programs of the user's own answer, one line of JSON each; docs/own-solver.md has the protocol. A line that is
// none of the protocol's is a WorkError with its beginning.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

// Of a solver that is asked: points, one after the other, coordinates from 0 to 1; or why it stops.
struct SolverAnswer {
  std::vector<double> points;
  std::string stop;  // empty: points
};
[[nodiscard]] SolverAnswer solver_answer(const std::string& line, const std::string& id, std::size_t dimension);

// Of an objective: as many costs as there are points, null being a point that has none.
[[nodiscard]] std::vector<std::optional<double>> objective_answer(const std::string& line, std::size_t points);

}  // namespace hysteron
