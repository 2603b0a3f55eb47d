#include "fit/law_start.hpp"

#include <algorithm>

namespace hysteron {
namespace {

// Of the whole budget: most of it belongs to the model that was asked for.
constexpr std::size_t part_of_budget = 4;

// Options without what they say of parameters that the model does not have.
LayoutOptions only_of(const CompositeModel& model, LayoutOptions options) {
  const std::vector<std::string> names = model.parameter_names();
  const auto keep = [&](auto& rows) {
    std::erase_if(rows, [&](const auto& row) { return std::ranges::find(names, row.first) == names.end(); });
  };
  keep(options.by_current);
  keep(options.by_frequency);
  keep(options.fix);
  keep(options.bounds);
  for (auto& [condition, orders] : options.by) {
    keep(orders);
  }
  return options;
}

}  // namespace

LawStart start_at_law(const Layout& layout, const std::string& model, const DataScale& scale,
                      const std::vector<const Recording*>& recordings, const IdentifyOptions& options,
                      const std::function<bool(const RunResult&)>& observe) {
  LawStart result{layout.initial(), 0};
  if (options.effects.empty()) {
    return result;
  }
  const CompositeModel law = make_model(model, {});
  const Layout alone(law, scale, only_of(law, options.layout));
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
  for (const ParameterLaw& from : alone.laws()) {
    const auto to = std::ranges::find_if(layout.laws(), [&](const ParameterLaw& one) {
      return layout.names()[one.parameter] == alone.names()[from.parameter];
    });
    if (to == layout.laws().end()) {
      continue;
    }
    for (std::size_t k = 0; k < std::min(from.count(), to->count()); ++k) {
      result.point[to->first + k] =
          std::clamp(layout.unit(to->first + k, alone.physical(from.first + k, run.best[from.first + k])), 0.0, 1.0);
    }
  }
  return result;
}

}  // namespace hysteron
