#include "diagnose/search/of_fit.hpp"

#include <algorithm>

namespace hysteron {
namespace {

// The fit with the effect switched off and nothing refitted: its size, the first of its parameters, at the neutral
// value.
Fit switched_off(const Fit& fit, const std::string& effect) {
  Fit result = fit;
  const std::vector<std::string>& names = fit.layout->names();
  const auto size =
      std::ranges::find_if(names, [&](const std::string& name) { return name.starts_with(effect + "."); });
  const auto index = static_cast<std::size_t>(size - names.begin());
  for (Term& term : result.terms) {
    if (term.parameter == index) {
      const bool constant = term.drive_power == 0 && term.frequency_power == 0;
      term.value = constant ? fit.layout->cards()[index].initial : 0.0;
    }
  }
  return result;
}

}  // namespace

Locality locality_of(const Workbench& bench, const Fit& with, const Fit& without, const std::string& effect) {
  return locality_of(bench.split().fit, bench.residuals(with), bench.residuals(without),
                     bench.residuals(switched_off(with, effect)));
}

}  // namespace hysteron
