#include "diagnose/residual/evenness.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/robust.hpp"
#include "diagnose/residual/surrogate.hpp"
#include "diagnose/signal/features.hpp"
#include "diagnose/signal/noise.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 200;  // of a recording that is looked at
// Outliers are cut at this many robust standard deviations.
constexpr double cut = 4.0;

// The class of every value, of `count` classes with as many values each.
std::vector<std::size_t> classes_of(const std::vector<double>& values, std::size_t count) {
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  std::vector<double> edges;
  edges.reserve(count);
  for (std::size_t k = 1; k < count; ++k) {
    edges.push_back(sorted[k * sorted.size() / count]);
  }
  std::vector<std::size_t> result;
  result.reserve(values.size());
  for (const double value : values) {
    result.push_back(static_cast<std::size_t>(std::ranges::upper_bound(edges, value) - edges.begin()));
  }
  return result;
}

}  // namespace

void EvennessSum::add(const Recording& recording, const Residual& residual, double scale) {
  const std::size_t from = residual.from;
  const std::size_t size = recording.size() - std::min(from, recording.size());
  if (size < fewest_samples) {
    return;
  }
  const auto tail = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(from), values.end());
  };
  std::vector<double> r = tail(residual.force);
  const double centre = median_of(r);
  const double limit = cut * robust_deviation(r, centre);
  std::vector<double> force(size);
  double mean = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    force[n] = recording.force[from + n] + r[n];
    mean += force[n] / static_cast<double>(size);
    r[n] = std::clamp(r[n], -limit, limit) / scale;
  }
  const auto absolute = [](std::vector<double> values, double around) {
    for (double& value : values) {
      value = std::fabs(value - around);
    }
    return values;
  };
  const std::vector<double> velocity = tail(recording.velocity);
  const std::array<std::vector<double>, variables> motion = {
      tail(recording.displacement), velocity,
      absolute(velocity, 0.0),      force,
      absolute(force, mean),        tail(features_of(recording).since_reversal_time)};
  const std::vector<std::size_t> blocks = half_cycles(recording, from);
  const Stream stream = Stream(0).child("evenness").child(added_++);
  std::array<std::vector<double>, 1 + chances> drawn;
  drawn[0] = std::move(r);
  for (std::size_t s = 1; s <= chances; ++s) {
    drawn[s] = surrogate(drawn[0], blocks, stream.child(s));
  }
  for (std::size_t i = 0; i < variables; ++i) {
    const std::vector<std::size_t> of = classes_of(motion[i], classes);
    std::array<double, classes> count{};
    for (const std::size_t k : of) {
      count[k] += 1.0;
    }
    for (std::size_t s = 0; s <= chances; ++s) {
      std::array<double, classes> sum{};
      for (std::size_t n = 0; n < size; ++n) {
        sum[of[n]] += drawn[s][n] * drawn[s][n];
      }
      for (std::size_t k = 0; k < classes; ++k) {
        squares_[s][i][k] += sum[k] / std::max(count[k], 1.0);
      }
    }
  }
}

Evenness EvennessSum::result() const {
  Evenness result;
  for (std::size_t s = 0; s <= chances; ++s) {
    double largest = 0.0;
    for (const std::array<double, classes>& of : squares_[s]) {
      double mean = 0.0;
      for (const double square : of) {
        mean += square / classes;
      }
      double deviation = 0.0;
      for (const double square : of) {
        deviation += mean > 0.0 ? (square / mean - 1.0) * (square / mean - 1.0) / classes : 0.0;
      }
      largest = std::max(largest, deviation);
    }
    (s == 0 ? result.deviation : result.by_chance) = std::max(s == 0 ? 0.0 : result.by_chance, largest);
  }
  return result;
}

}  // namespace hysteron
