#include "diagnose/wander.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hysteron {
namespace {

constexpr std::size_t stretches = 15;
constexpr std::size_t fewest_samples = 20;  // of a stretch
constexpr std::size_t shifts = 15;
constexpr double least_share = 0.4;
constexpr double clear_of_chance = 1.5;
// Outliers are cut at this many root mean squares of the residual.
constexpr double cut = 5.0;

// Squares that the best factor of each stretch takes off the residual, shifted circularly by `shift` samples.
double taken_off(const std::vector<double>& residual, const std::vector<double>& force, std::size_t shift) {
  const std::size_t size = residual.size();
  double result = 0.0;
  for (std::size_t k = 0; k < stretches; ++k) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t n = k * size / stretches; n < (k + 1) * size / stretches; ++n) {
      product += residual[(n + shift) % size] * force[n];
      square += force[n] * force[n];
    }
    result += square > 0.0 ? product * product / square : 0.0;
  }
  return result;
}

}  // namespace

Wandering wandering(const Workbench& bench, const Fit& fit) {
  double squares = 0.0;
  std::vector<double> taken(1 + shifts, 0.0);
  for (const Recording& recording : bench.split().fit) {
    const Residual residual = bench.residual(fit, recording);
    const auto from = static_cast<std::ptrdiff_t>(residual.from);
    std::vector<double> r(residual.force.begin() + from, residual.force.end());
    if (r.size() < stretches * fewest_samples) {
      continue;
    }
    const double limit = cut * std::sqrt(residual.mean_square());
    std::vector<double> force(r.size());
    double mean = 0.0;
    for (std::size_t n = 0; n < r.size(); ++n) {
      force[n] = recording.force[n + residual.from] + r[n];
      mean += force[n] / static_cast<double>(r.size());
    }
    const double norm = normaliser(recording, bench.options().normalisation);
    for (std::size_t n = 0; n < r.size(); ++n) {
      force[n] -= mean;
      r[n] = std::clamp(r[n], -limit, limit) / norm;
      squares += r[n] * r[n];
    }
    for (std::size_t k = 0; k <= shifts; ++k) {
      // Shifts stay away from none at all.
      taken[k] += taken_off(r, force, k == 0 ? 0 : r.size() * (k + 2) / (shifts + 5));
    }
  }
  if (!(squares > 0.0)) {
    return {};
  }
  return {taken[0] / squares, *std::max_element(taken.begin() + 1, taken.end()) / squares};
}

bool wanders(const Wandering& wandering) {
  return wandering.share > least_share && wandering.share > clear_of_chance * wandering.by_chance;
}

}  // namespace hysteron
