#include "diagnose/residual/independent.hpp"

#include <algorithm>
#include <cmath>

#include "core/frequency.hpp"
#include "core/robust.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 8;    // of a recording that has a correlation
constexpr double longest_lag = 0.25;         // of the duration
constexpr std::size_t every_lag_below = 32;  // samples; longer lags are taken in steps that grow
constexpr double lag_growth = 1.0 / 16.0;    // of a lag, the step to the next

double usual_step(const std::vector<double>& time, std::size_t from) {
  std::vector<double> steps;
  steps.reserve(time.size() - from);
  for (std::size_t n = from + 1; n < time.size(); ++n) {
    steps.push_back(time[n] - time[n - 1]);
  }
  return median_of(std::move(steps));
}

// Part of the duration that each sample stands for.
std::vector<double> shares_of(const std::vector<double>& time, std::size_t from) {
  std::vector<double> result(time.size(), 0.0);
  const double duration = time.back() - time[from];
  for (std::size_t n = from; n < time.size(); ++n) {
    const double before = time[n == from ? n : n - 1];
    const double after = time[n + 1 == time.size() ? n : n + 1];
    result[n] = 0.5 * (after - before) / duration;
  }
  return result;
}

}  // namespace

double correlation_time(const std::vector<double>& time, const Residual& residual) {
  const std::vector<double>& r = residual.force;
  const std::size_t from = residual.from;
  if (r.size() < from + fewest_samples) {
    return 0.0;
  }
  const double step = usual_step(time, from);
  const std::vector<double> share = shares_of(time, from);
  // Mean product of the residual with that of the sample nearest to `lag` later.
  const auto product_at = [&](double lag) {
    double sum = 0.0;
    std::size_t m = from;
    for (std::size_t n = from; n < r.size() && time[n] + lag <= time.back() + 0.5 * step; ++n) {
      const double at = time[n] + lag;
      m = std::max(m, n);
      while (m + 1 < r.size() && std::fabs(time[m + 1] - at) <= std::fabs(time[m] - at)) {
        ++m;
      }
      sum += share[n] * r[n] * r[m];
    }
    return sum;
  };
  const double square = product_at(0.0);
  if (!(square > 0.0)) {
    return 0.0;
  }
  // Trapezia: of neighbouring lags each is half of a pair, the first of the sample with itself and with the next.
  double integral = 0.0;
  double lag = 0.0;
  double here = square;
  double width = step;
  const double last = longest_lag * (time.back() - time[from]);
  while (lag + width <= last) {
    const double next = product_at(lag + width);
    if (!(here + next > 0.0)) {
      break;
    }
    integral += 0.5 * width * (here + next);
    here = next;
    lag += width;
    if (lag > static_cast<double>(every_lag_below) * step) {
      width = std::max(1.0, std::floor(lag_growth * lag / step)) * step;
    }
  }
  return 2.0 * integral / square;
}

double independent_values(const Recording& recording, const Residual& residual) {
  if (recording.size() < residual.from + 2) {
    return 0.0;
  }
  const double duration = recording.time.back() - recording.time[residual.from];
  const double frequency = dominant_frequency(recording);
  const double half_cycle = frequency > 0.0 ? 0.5 / frequency : duration;
  const double sample = duration / static_cast<double>(recording.size() - residual.from);
  return duration / std::max({correlation_time(recording.time, residual), half_cycle / values_per_half_cycle, sample});
}

}  // namespace hysteron
