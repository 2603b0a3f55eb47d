#include "diagnose/residual/locality.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/signal/noise.hpp"

namespace hysteron {
namespace {

constexpr double acting = 0.02;

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
  Locality result;
  double acted = 0.0;
  double counted = 0.0;
  const Fit off = switched_off(with, effect);
  for (const Recording& recording : bench.split().fit) {
    const Residual after = bench.residual(with, recording);
    const Residual before = bench.residual(without, recording);
    const Residual neutral = bench.residual(off, recording);
    const double norm = normaliser(recording, bench.options().normalisation);
    const double noise = noise_floor(recording).sigma / norm;
    for (std::size_t n = std::max(after.from, before.from); n < after.force.size(); ++n) {
      counted += 1.0;
      if (std::fabs(neutral.force[n] - after.force[n]) > acting * norm) {
        acted += 1.0;
        result.after += squared(after.force[n] / norm);
        result.before += squared(before.force[n] / norm);
        result.noise += noise * noise;
      }
    }
  }
  result.share = counted > 0.0 ? acted / counted : 0.0;
  return result;
}

}  // namespace hysteron
