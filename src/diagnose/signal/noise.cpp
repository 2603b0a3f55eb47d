#include "diagnose/signal/noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/drive.hpp"
#include "core/random.hpp"
#include "fit/layout.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// Cubic Lagrange interpolation with the squared sum of its weights, through which white noise passes.
struct Interpolated {
  double value;
  double noise;
};

Interpolated interpolate(const std::vector<double>& t, const std::vector<double>& y, double at) {
  const auto upper = std::ranges::upper_bound(t, at);
  const auto above = static_cast<std::ptrdiff_t>(upper - t.begin());
  const auto size = static_cast<std::ptrdiff_t>(t.size());
  const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(above - 2, 0, size - 4);
  Interpolated result{0.0, 0.0};
  for (std::ptrdiff_t k = first; k < first + 4; ++k) {
    double weight = 1.0;
    for (std::ptrdiff_t m = first; m < first + 4; ++m) {
      if (m != k) {
        weight *=
            (at - t[static_cast<std::size_t>(m)]) / (t[static_cast<std::size_t>(k)] - t[static_cast<std::size_t>(m)]);
      }
    }
    result.value += weight * y[static_cast<std::size_t>(k)];
    result.noise += weight * weight;
  }
  return result;
}

// Standard deviation around zero with outliers beyond six robust deviations cut off.
double clipped_deviation(const std::vector<double>& values) {
  std::vector<double> sizes(values.size());
  std::ranges::transform(values, sizes.begin(), [](double v) { return std::fabs(v); });
  const double robust = 1.4826 * median_of(sizes);
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (robust <= 0.0 || std::fabs(value) <= 6.0 * robust) {
      sum += value * value;
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

// Mean square of x(t + period) - x(t).
double misfold(const Recording& recording, double period, double begins, double ends) {
  double sum = 0.0;
  std::size_t count = 0;
  const std::size_t step = std::max<std::size_t>(1, recording.size() / 2000);
  for (std::size_t n = 0; n < recording.size(); n += step) {
    const double t = recording.time[n];
    if (t < begins || t + period > ends) {
      continue;
    }
    const double d = interpolate(recording.time, recording.displacement, t + period).value - recording.displacement[n];
    sum += d * d;
    ++count;
  }
  return count == 0 ? 1e300 : sum / static_cast<double>(count);
}

}  // namespace

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

Periodicity periodicity(const Recording& recording) {
  Periodicity result;
  const double frequency = dominant_frequency(recording);
  if (!(frequency > 0.0) || recording.size() < 16) {
    return result;
  }
  double peak = 0.0;
  for (const double v : recording.velocity) {
    peak = std::max(peak, std::fabs(v));
  }
  std::size_t first = 0;
  std::size_t last = recording.size() - 1;
  while (first < last && std::fabs(recording.velocity[first]) < 0.3 * peak) {
    ++first;
  }
  while (last > first && std::fabs(recording.velocity[last]) < 0.3 * peak) {
    --last;
  }
  // The first half period is often a run-in.
  double period = 1.0 / frequency;
  result.begins = recording.time[first] + 0.5 * period;
  result.ends = recording.time[last];
  if (result.ends - result.begins < 2.0 * period) {
    return result;
  }
  double best = 1e300;
  constexpr int zooms = 8;
  for (int zoom = 0; zoom < zooms; ++zoom) {
    const double width = 0.04 * std::pow(0.25, zoom);
    const double centre = period;
    for (int k = -4; k <= 4; ++k) {
      const double trial = centre * (1.0 + width * k / 4.0);
      const double error = misfold(recording, trial, result.begins, result.ends);
      if (error < best) {
        best = error;
        period = trial;
      }
    }
  }
  double mean = 0.0;
  double square = 0.0;
  double count = 0.0;
  for (std::size_t n = first; n <= last; ++n) {
    mean += recording.displacement[n];
    square += recording.displacement[n] * recording.displacement[n];
    count += 1.0;
  }
  const double variance = square / count - mean * mean / (count * count);
  if (best < 2.0 * 0.03 * 0.03 * variance) {
    result.period = period;
  }
  return result;
}

NoiseFloor noise_floor(const Recording& recording) {
  NoiseFloor result;
  if (recording.size() < 16) {
    return result;
  }
  const std::vector<double> fourth = fourth_differences(recording.force);
  std::vector<double> sizes(fourth.size());
  std::ranges::transform(fourth, sizes.begin(), [](double v) { return std::fabs(v); });
  result.white = 1.4826 * median_of(sizes);
  if (result.white <= 0.0) {
    result.white = clipped_deviation(fourth);
  }
  // Periods that repeat are rounded alike, and a force that rests on a step shows no differences.
  const double rounding = channel_quantum(recording.force) / std::sqrt(12.0);
  result.rounded = rounding >= result.white;
  result.white = std::max(result.white, rounding);
  const Periodicity cycle = periodicity(recording);
  if (cycle.period > 0.0) {
    std::vector<double> differences;
    double noise = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double t = recording.time[n];
      if (t < cycle.begins || t + cycle.period > cycle.ends) {
        continue;
      }
      const Interpolated next = interpolate(recording.time, recording.force, t + cycle.period);
      differences.push_back(next.value - recording.force[n]);
      noise += 1.0 + next.noise;
    }
    if (differences.size() >= 16) {
      result.sigma = std::max(
          clipped_deviation(differences) / std::sqrt(noise / static_cast<double>(differences.size())), rounding);
      result.method = "cycles";
      result.cycles = (cycle.ends - cycle.begins) / cycle.period;
      return result;
    }
  }
  result.sigma = result.white;
  result.method = "high-pass";
  return result;
}

Recording shaken(const Recording& recording) {
  Recording result = recording;
  const Stream stream = Stream(1).child("noise of the motion");
  const double of_displacement = channel_noise(recording.time, recording.displacement);
  for (std::size_t n = 0; n < result.size(); ++n) {
    result.displacement[n] += of_displacement * stream.normal(n, 0);
  }
  if (recording.velocity_measured) {
    const double of_velocity = channel_noise(recording.time, recording.velocity);
    for (std::size_t n = 0; n < result.size(); ++n) {
      result.velocity[n] += of_velocity * stream.normal(n, 1);
    }
  } else {
    // A copy with fewer samples keeps the velocity of all: only the change is its own.
    const std::vector<double> before = derive_velocity(recording.time, recording.displacement);
    const std::vector<double> after = derive_velocity(recording.time, result.displacement);
    for (std::size_t n = 0; n < result.size(); ++n) {
      result.velocity[n] += after[n] - before[n];
    }
  }
  if (!recording.derived_acceleration.empty()) {
    result.derived_acceleration =
        derive_acceleration(recording.time, result.displacement, result.velocity, recording.velocity_measured);
  }
  return result;
}

}  // namespace hysteron
