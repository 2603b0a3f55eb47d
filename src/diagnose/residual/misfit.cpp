#include "diagnose/residual/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/residual/independent.hpp"
#include "diagnose/residual/structure.hpp"

namespace hysteron {
Misfit misfit_of(const std::vector<Recording>& recordings, const Residuals& residuals) {
  Misfit result;
  double predictable = 0.0;
  double structure = 0.0;
  EvennessSum evenness;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Residual& residual = residuals.of[k];
    const double norm = residuals.norms[k];
    const NoiseFloor& floor = residuals.noise[k];
    evenness.add(recordings[k], residual, norm);
    result.independent += independent_values(recordings[k], residual);
    const double mean = residual.mean_square() / (norm * norm);
    const double share = std::max(0.0, predictable_share(recordings[k], residual.force));
    predictable += share * mean;
    const double passed = residuals.passed_on[k] / (norm * norm);
    const double noise = squared(floor.sigma / norm) + passed;
    // Periods tell the noise whatever its colour, but what changes from one to the next in no simple way looks like
    // noise too; what repeats with the motion is surely none, unless it is what rounding leaves.
    const bool known = floor.method == NoiseMethod::cycles || floor.rounded;
    structure += std::max(known ? mean - noise : 0.0, floor.rounded ? 0.0 : share * mean);
    result.squares += mean;
    result.white += std::min(mean, squared(floor.white / norm) + passed);
    result.floor += std::min(mean, noise);
    result.motion += std::min(mean, passed);
  }
  const auto count = static_cast<double>(recordings.size());
  result.squares /= count;
  result.white /= count;
  result.floor /= count;
  result.motion /= count;
  result.structure = structure / count;
  result.predictable = result.squares > 0.0 ? predictable / count / result.squares : 0.0;
  result.evenness = evenness.result();
  result.noise = result.squares - result.structure;
  return result;
}

bool structured(const Misfit& misfit) {
  const double ratio = misfit.structure / std::max(misfit.noise, 1e-300);
  return ratio > 0.3 || (ratio > 0.08 && misfit.predictable > 0.1);
}

double evidence(double before, double after, double more, double independent) {
  return independent * std::log(before / after) - more * std::log(independent);
}

}  // namespace hysteron
