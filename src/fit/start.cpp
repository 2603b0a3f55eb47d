#include "fit/start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/layout.hpp"

namespace hysteron {
namespace {

// A force that settles does so within this part of the first period, and there differs from the next one by this factor
// more than later, and by this share of the peak force.
constexpr std::size_t settling_part = 8;
constexpr double settling_factor = 3.0;
constexpr double settling_share = 0.05;

// Whether the force of a recording in mid-motion comes out of nothing, as that of a damper that was at rest in the
// position of the first sample: it differs from the force one period later at the start, and then no more.
bool force_settles(const Recording& recording, std::size_t period) {
  if (recording.force.empty() || recording.size() < 2 * period) {
    return false;
  }
  double peak = 0.0;
  for (const double force : recording.force) {
    peak = std::max(peak, std::fabs(force));
  }
  // The second largest: one outlier tells nothing.
  std::array<double, 2> early = {0.0, 0.0};
  double late = 0.0;
  for (std::size_t n = 0; n < period; ++n) {
    const double change = std::fabs(recording.force[n + period] - recording.force[n]);
    if (n >= period / settling_part) {
      late = std::max(late, change);
    } else if (change > early[0]) {
      early = {change, early[0]};
    } else {
      early[1] = std::max(early[1], change);
    }
  }
  return early[1] > settling_factor * late && early[1] > settling_share * peak;
}

}  // namespace

std::size_t returns_after(const Recording& recording, double frequency) {
  if (!(frequency > 0.0)) {
    return 0;
  }
  double peak = 0.0;
  for (const double velocity : recording.velocity) {
    peak = std::max(peak, std::fabs(velocity));
  }
  const auto [low, high] = std::ranges::minmax(recording.displacement);
  const double stroke = high - low;
  if (std::fabs(recording.velocity[0]) < 0.05 * peak) {
    // At a turning point of a running motion the velocity is small too: at rest it stays small.
    const double quarter = recording.time[0] + 0.125 / frequency;
    bool moves = false;
    for (std::size_t n = 0; n < recording.size() && recording.time[n] < quarter; ++n) {
      moves = moves || std::fabs(recording.velocity[n]) > 0.3 * peak;
    }
    if (!moves) {
      return 0;
    }
  }
  const double expected = recording.time[0] + 1.0 / frequency;
  std::size_t best = 0;
  double best_distance = 0.1;
  for (std::size_t n = 1; n < recording.size() && recording.time[n] < expected + 0.25 / frequency; ++n) {
    if (recording.time[n] < expected - 0.25 / frequency) {
      continue;
    }
    const double distance = std::fabs(recording.displacement[n] - recording.displacement[0]) / stroke +
                            std::fabs(recording.velocity[n] - recording.velocity[0]) / peak;
    if (distance < best_distance) {
      best_distance = distance;
      best = n;
    }
  }
  return best;
}

Start start_of(const Recording& recording) {
  if (recording.start != Start::unknown) {
    return recording.start;
  }
  const std::size_t period = returns_after(recording, dominant_frequency(recording));
  return period > 0 && force_settles(recording, period) ? Start::from_nothing : Start::in_cycle;
}

}  // namespace hysteron
