#include "diagnose/base_bounds.hpp"

#include <algorithm>

#include "fit/bounds_met.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/objective.hpp"

namespace hysteron {

std::string note_of_bounds(const Workbench& bench, const Fit& base) {
  if (std::ranges::none_of(base.point, on_bound)) return {};
  const std::vector<Recording>& fitted = bench.split().fit;
  const Objective objective(*base.layout, fitted, bench.options());
  const EndsMet ends =
      ends_met(*base.layout, objective.evaluate({base.point, true}), base.point, fitted.front().drive_kind);
  return ends.costs ? "in the fit of " + base.what.model + " alone " + ends.text : std::string();
}

}  // namespace hysteron
