#include "fit/no_candidate.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/message.hpp"
#include "fit/solver.hpp"

namespace hysteron {

void throw_without_candidate(const std::string& stage, const RunResult& run, const Layout& layout,
                             const LayoutOptions& options, std::size_t before) {
  const std::string solver = (stage.empty() ? "" : stage + ": ") + "solver " + run.solver;
  const std::size_t with_derivatives = layout.dimension() + 1;
  if (run.evaluations == before && run.budget >= before + with_derivatives) {
    throw WorkError(solver + " stopped before its first evaluation" + (run.reason.empty() ? "" : ": " + run.reason));
  }
  if (run.evaluations == before) {
    throw OptionError(Message(solver + " cannot evaluate anything in a budget of " + std::to_string(run.budget) +
                              (before > 0 ? ", " + std::to_string(before) + " of which are spent" : "") +
                              ", expected a larger ") +
                      Option::budget + (": an evaluation with derivatives counts " + std::to_string(with_derivatives)));
  }
  // An objective is a sum of squares, and one of diverged_cost is none (fit/solver.hpp).
  const std::string text = solver +
                           " found no candidate whose simulation stays finite and misses the recordings by less than " +
                           std::to_string(std::lround(std::sqrt(diverged_cost))) + " times their size in " +
                           std::to_string(run.evaluations - before) + " evaluations";
  const bool held = !options.fix.empty();
  const bool bounded = !options.bounds.empty();
  throw WorkError(text + (held && bounded ? ": check what is held and the bounds"
                          : held          ? ": check what is held"
                          : bounded       ? ": check the bounds"
                                          : ""));
}

}  // namespace hysteron
