#include "fit/law_start.hpp"

namespace hysteron {
namespace {

// Of the whole budget: most of it belongs to the model that was asked for.
constexpr std::size_t part_of_budget = 4;

}  // namespace

LawStart start_at_law(const Layout& layout, const std::string& model, const DataScale& scale,
                      const std::vector<const Recording*>& recordings, const IdentifyOptions& options,
                      const std::function<bool(const RunResult&)>& observe) {
  LawStart result{layout.initial(), 0};
  if (options.effects.empty()) {
    return result;
  }
  const CompositeModel law = make_model(model, {});
  const Layout alone(law, scale, only_of(law.parameter_names(), options.layout));
  const std::size_t budget = options.budget / part_of_budget;
  if (alone.dimension() == 0 || budget <= alone.dimension()) {
    return result;
  }
  const SolverEntry& entry = *find_solver("multistart-lm");
  const Objective objective(alone, recordings, options.objective);
  IdentifyOptions descent = options;
  descent.budget = budget;
  descent.settings.clear();
  const RunResult run = run_solver(
      entry, make_problem(objective, entry, descent, "law alone", alone.initial()),
      [&](const Request& request) { return objective.evaluate(request); }, observe);
  result.evaluations = run.evaluations;
  if (run.best.empty() || run.cost >= diverged_cost) {
    return result;
  }
  carry_over(alone, alone.terms(run.best), layout, result.point);
  return result;
}

}  // namespace hysteron
