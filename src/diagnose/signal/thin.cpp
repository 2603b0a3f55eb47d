#include "diagnose/signal/thin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "fit/start.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

constexpr std::array<std::size_t, 9> factors = {2, 3, 4, 5, 6, 8, 10, 12, 16};
constexpr double displacement_error = 1e-3;
constexpr double velocity_error = 1e-2;

double deviation(const std::vector<double>& values) {
  double sum = 0.0;
  double square = 0.0;
  for (const double value : values) {
    sum += value;
    square += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(std::max(square / count - sum * sum / (count * count), 0.0));
}

bool recovers(const Recording& whole, const Recording& part, std::size_t k) {
  const Motion motion = make_motion(part.time, part.displacement, part.velocity, {});
  double x_error = 0.0;
  double v_error = 0.0;
  double count = 0.0;
  for (std::size_t n = 0; n < motion.intervals.size(); ++n) {
    for (std::size_t m = 1; m < k && n * k + m < whole.size(); ++m) {
      const std::size_t at = n * k + m;
      const double theta = (whole.time[at] - part.time[n]) / motion.intervals[n].length;
      const double x = cubic(motion.intervals[n].x, theta) - whole.displacement[at];
      const double v = cubic(motion.intervals[n].v, theta) - whole.velocity[at];
      x_error += x * x;
      v_error += v * v;
      count += 1.0;
    }
  }
  return std::sqrt(x_error / count) <= displacement_error * deviation(whole.displacement) &&
         std::sqrt(v_error / count) <= velocity_error * deviation(whole.velocity);
}

}  // namespace

std::vector<Recording> thinned(const std::vector<Recording>& recordings, std::size_t total) {
  std::size_t samples = 0;
  for (const Recording& recording : recordings) {
    samples += recording.size();
  }
  std::vector<Recording> result;
  for (const Recording& recording : recordings) {
    Recording best = recording;
    // Long recordings give up more: each has an equal share of what is kept.
    const std::size_t share = std::max<std::size_t>(total / recordings.size(), 200);
    if (samples > total) {
      for (const std::size_t k : factors) {
        if (best.size() <= share) {
          break;
        }
        Recording part = every_kth(recording, k);
        part.start = start_of(recording);
        if (part.size() < 100 || !recovers(recording, part, k)) {
          break;
        }
        best = std::move(part);
      }
    }
    result.push_back(std::move(best));
  }
  return result;
}

std::vector<Recording> spread(const std::vector<Recording>& recordings, std::size_t count) {
  if (recordings.size() <= count) {
    return recordings;
  }
  std::vector<std::tuple<double, double, std::size_t>> order;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    double speed = 0.0;
    for (const double velocity : recordings[k].velocity) {
      speed = std::max(speed, std::fabs(velocity));
    }
    order.emplace_back(recordings[k].drive.empty() ? 0.0 : recordings[k].drive[recordings[k].size() / 2], speed, k);
  }
  std::ranges::sort(order);
  std::vector<std::size_t> chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(std::get<2>(order[i * (order.size() - 1) / (count - 1)]));
  }
  std::ranges::sort(chosen);
  std::vector<Recording> result;
  result.reserve(chosen.size());
  for (const std::size_t k : chosen) {
    result.push_back(recordings[k]);
  }
  return result;
}

}  // namespace hysteron
