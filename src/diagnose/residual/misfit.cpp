#include "diagnose/residual/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/residual/structure.hpp"
#include "diagnose/signal/noise.hpp"

namespace hysteron {
namespace {

constexpr std::size_t lags = 201;

// Mean square of what the noise of the recorded motion makes of the model's force, N^2.
double passed_on(const Workbench& bench, const Fit& fit, const Recording& recording, const Residual& residual) {
  // Both are compared with the same recorded force: the difference is that of the simulated ones.
  Residual change = bench.residual(fit, shaken(recording));
  change.from = std::max(change.from, residual.from);
  for (std::size_t n = 0; n < change.force.size(); ++n) {
    change.force[n] -= residual.force[n];
  }
  return change.mean_square();
}

// Adds the products of a residual with itself some samples later, over scale^2.
void add_products(std::vector<double>& products, const Residual& residual, double scale) {
  const std::vector<double>& r = residual.force;
  for (std::size_t lag = 0; lag < products.size(); ++lag) {
    for (std::size_t n = residual.from + lag; n < r.size(); ++n) {
      products[lag] += r[n] * r[n - lag] / (scale * scale);
    }
  }
}

// Samples for one of independent information: the correlations of all lags, in pairs while these are positive (Geyer,
// Statistical Science 7 (1992) 473).
double memory_of(const std::vector<double>& products) {
  double memory = 1.0;
  for (std::size_t lag = 1; lag + 1 < products.size(); lag += 2) {
    const double pair = (products[lag] + products[lag + 1]) / products[0];
    if (!(pair > 0.0)) {
      break;
    }
    memory += 2.0 * pair;
  }
  return memory;
}

}  // namespace

Misfit misfit_of(const Workbench& bench, const Fit& fit) {
  Misfit result;
  double cross = 0.0;
  double energy = 0.0;
  double predictable = 0.0;
  double structure = 0.0;
  double counted = 0.0;
  std::vector<double> products(lags, 0.0);
  EvennessSum evenness;
  const std::vector<Recording>& recordings = bench.split().fit;
  for (const Recording& recording : recordings) {
    const Residual residual = bench.residual(fit, recording);
    const std::vector<double>& r = residual.force;
    const double norm = normaliser(recording, bench.options().normalisation);
    for (std::size_t n = residual.from; n < r.size(); ++n) {
      energy += r[n] * r[n] / (norm * norm);
      if (n > residual.from) {
        cross += r[n] * r[n - 1] / (norm * norm);
      }
    }
    evenness.add(recording, residual, norm);
    add_products(products, residual, norm);
    counted += static_cast<double>(r.size() - residual.from);
    const double mean = residual.mean_square() / (norm * norm);
    const NoiseFloor floor = noise_floor(recording);
    const double share = std::max(0.0, predictable_share(recording, r));
    predictable += share * mean;
    const double passed = passed_on(bench, fit, recording, residual) / (norm * norm);
    const double noise = squared(floor.sigma / norm) + passed;
    // Periods tell the noise whatever its colour, but what fades or grows over them looks like noise too; what repeats
    // with the motion is surely none, unless it is what rounding leaves.
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
  result.predictable = predictable / count / result.squares;
  result.evenness = evenness.result();
  result.noise = result.squares - result.structure;
  result.correlation = std::clamp(cross / energy, 0.0, 0.999);
  result.effective = std::max(counted * (1.0 - result.correlation) / (1.0 + result.correlation), 20.0);
  result.independent = std::max(counted / memory_of(products), 20.0);
  return result;
}

bool structured(const Misfit& misfit) {
  const double ratio = misfit.structure / std::max(misfit.noise, 1e-300);
  return ratio > 0.3 || (ratio > 0.08 && misfit.predictable > 0.1);
}

bool noise_like(const Misfit& misfit) {
  return !structured(misfit) && misfit.predictable < 0.03 && even(misfit.evenness);
}

double evidence(double before, double after, double more, double effective) {
  return effective * std::log(before / after) - more * std::log(effective);
}

}  // namespace hysteron
