#include "diagnose/residual/wander.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace hysteron {
namespace {

constexpr std::size_t stretches = 15;       // of a recording, each with a factor of its own
constexpr std::size_t fewest_samples = 20;  // of a stretch
// Cycles: frequencies up to this one, this many per resolvable step, at most so many in all; a recording counts from
// this many cycles on.
constexpr double highest_frequency = 5.0;
constexpr double steps_per_resolution = 4.0;
constexpr double most_frequencies = 1000.0;
constexpr double fewest_cycles = 1.5;
// The factor of a sine has fewer freedoms than one of stretches: less of it is by chance.
constexpr double least_share_of_cycle = 0.3;
constexpr double least_share = 0.4;
constexpr double clear_of_chance = 1.5;
// Outliers are cut at this many root mean squares of the residual.
constexpr double cut = 5.0;

using Values = std::vector<double>;

// Samples after which the force is no longer like itself: where its autocorrelation first falls to zero.
std::size_t unlike_after(const Values& force) {
  const std::size_t size = force.size();
  for (std::size_t lag = 1; lag < size / 2; ++lag) {
    double product = 0.0;
    for (std::size_t n = lag; n < size; ++n) {
      product += force[n] * force[n - lag];
    }
    if (product <= 0.0) {
      return lag;
    }
  }
  return size / 4;
}

Values rotated(Values values, std::size_t by) {
  std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(by), values.end());
  return values;
}

// Squares that the best factor of each stretch takes off the residual.
double taken_by_stretches(const Values& residual, const Values& force) {
  const std::size_t size = residual.size();
  double result = 0.0;
  for (std::size_t k = 0; k < stretches; ++k) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t n = k * size / stretches; n < (k + 1) * size / stretches; ++n) {
      product += residual[n] * force[n];
      square += force[n] * force[n];
    }
    result += square > 0.0 ? product * product / square : 0.0;
  }
  return result;
}

// Squares that the best a sin wt + b cos wt times the force takes off, for every angular frequency.
Values taken_by_cycles(const Values& time, const Values& residual, const Values& force, const Values& angular) {
  Values result;
  for (const double w : angular) {
    if (w * (time.back() - time.front()) < fewest_cycles * 2.0 * std::numbers::pi) {
      result.push_back(0.0);
      continue;
    }
    double rs = 0.0;
    double rc = 0.0;
    double ss = 0.0;
    double sc = 0.0;
    double cc = 0.0;
    for (std::size_t n = 0; n < time.size(); ++n) {
      const double s = force[n] * std::sin(w * time[n]);
      const double c = force[n] * std::cos(w * time[n]);
      rs += residual[n] * s;
      rc += residual[n] * c;
      ss += s * s;
      sc += s * c;
      cc += c * c;
    }
    const double determinant = ss * cc - sc * sc;
    result.push_back(determinant > 1e-9 * ss * cc ? (rs * rs * cc - 2.0 * rs * rc * sc + rc * rc * ss) / determinant
                                                  : 0.0);
  }
  return result;
}

// The residual less its best constant multiple of the force: recordings may differ in size.
Values less_constant(const Values& residual, const Values& force) {
  const double product = std::inner_product(residual.begin(), residual.end(), force.begin(), 0.0);
  const double square = std::inner_product(force.begin(), force.end(), force.begin(), 0.0);
  const double factor = square > 0.0 ? product / square : 0.0;
  Values result(residual.size());
  std::ranges::transform(residual, force, result.begin(), [&](double r, double f) { return r - factor * f; });
  return result;
}

Values frequencies_for(const std::vector<Leftover>& leftovers) {
  double longest = 0.0;
  for (const Leftover& one : leftovers) {
    longest = std::max(longest, one.time.back() - one.time.front());
  }
  const double step = std::max(1.0 / (steps_per_resolution * longest), highest_frequency / most_frequencies);
  const double lowest = fewest_cycles / longest;
  const auto count = static_cast<std::size_t>(std::max(0.0, std::ceil((highest_frequency - lowest) / step)));
  Values angular(count);
  for (std::size_t k = 0; k < count; ++k) {
    angular[k] = 2.0 * std::numbers::pi * (lowest + static_cast<double>(k) * step);
  }
  return angular;
}

void add(Values& sum, const Values& values) { std::ranges::transform(sum, values, sum.begin(), std::plus<>()); }

}  // namespace

Wandering wandering(const std::vector<Leftover>& all) {
  std::vector<Leftover> leftovers;
  for (const Leftover& one : all) {
    if (one.residual.size() >= stretches * fewest_samples) {
      leftovers.push_back(one);
    }
  }
  if (leftovers.empty()) {
    return {};
  }
  const Values angular = frequencies_for(leftovers);
  double squares = 0.0;
  Wandering by_stretches;
  Values cycle(angular.size(), 0.0);
  Values cycle_by_chance(angular.size(), 0.0);
  for (Leftover& one : leftovers) {
    const double square = std::inner_product(one.residual.begin(), one.residual.end(), one.residual.begin(), 0.0);
    const double limit = cut * std::sqrt(square / static_cast<double>(one.residual.size()));
    const double mean =
        std::accumulate(one.force.begin(), one.force.end(), 0.0) / static_cast<double>(one.force.size());
    for (std::size_t n = 0; n < one.force.size(); ++n) {
      one.force[n] -= mean;
      one.residual[n] = std::clamp(one.residual[n], -limit, limit);
      squares += one.residual[n] * one.residual[n];
    }
    const Values other = rotated(one.force, unlike_after(one.force));
    const Values here = less_constant(one.residual, one.force);
    const Values there = less_constant(one.residual, other);
    by_stretches.share += taken_by_stretches(here, one.force);
    by_stretches.by_chance += taken_by_stretches(there, other);
    add(cycle, taken_by_cycles(one.time, here, one.force, angular));
    add(cycle_by_chance, taken_by_cycles(one.time, there, other, angular));
  }
  if (!(squares > 0.0)) {
    return {};
  }
  by_stretches.share /= squares;
  by_stretches.by_chance /= squares;
  if (angular.empty()) {
    return by_stretches;
  }
  const auto best = std::ranges::max_element(cycle);
  const Wandering by_cycles{*best / squares, *std::ranges::max_element(cycle_by_chance) / squares,
                            2.0 * std::numbers::pi / angular[static_cast<std::size_t>(best - cycle.begin())]};
  return wanders(by_stretches) && !wanders(by_cycles) ? by_stretches : by_cycles;
}

bool wanders(const Wandering& wandering) {
  return wandering.share > (wandering.period > 0.0 ? least_share_of_cycle : least_share) &&
         wandering.share > clear_of_chance * wandering.by_chance;
}

}  // namespace hysteron
