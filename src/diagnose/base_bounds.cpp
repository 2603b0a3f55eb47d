#include "diagnose/base_bounds.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/joined.hpp"
#include "diagnose/search/wording.hpp"
#include "fit/bounds_met.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/objective.hpp"

namespace hysteron {
namespace {

constexpr double least_told = 0.05;  // of the error

// "tau = 0.01 m/s" of each parameter, once.
std::vector<std::string> at_ends(const Fit& fit) {
  std::vector<std::string> result;
  for (const ParameterLaw& law : fit.layout->laws()) {
    const Parameter& card = fit.layout->cards()[law.parameter];
    for (std::size_t c = law.first; c < law.first + law.count(); ++c) {
      const bool upper = on_upper(fit.point[c]);
      if (!on_bound(fit.point[c]) || is_limit(card, upper)) continue;
      result.push_back(fit.layout->names()[law.parameter] + " = " +
                       size_text(upper ? card.box.upper : card.box.lower, std::string(card.unit), 2));
      break;
    }
  }
  return result;
}

}  // namespace

std::string note_of_bounds(const Workbench& bench, const Fit& base) {
  const std::vector<std::string> ends = at_ends(base);
  if (ends.empty()) return {};
  const Objective objective(*base.layout, bench.split().fit, bench.options());
  const Response derivatives = objective.evaluate({base.point, true});
  const std::optional<double> beyond = cost_beyond_bounds(*base.layout, derivatives, base.point);
  if (!beyond || !(*beyond < (1.0 - least_told) * derivatives.cost[0])) return {};
  return fmt::format(
      "{} of {} {} on an end of the range searched: a fit in a wider one may need less beside the law, its error "
      "falls by about {:.0f} %",
      joined(ends, " and "), base.what.model, ends.size() == 1 ? "sits" : "sit",
      100.0 * (1.0 - *beyond / derivatives.cost[0]));
}

}  // namespace hysteron
