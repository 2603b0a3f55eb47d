#include "diagnose/signal/features.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {

Features features_of(const Recording& recording) {
  Features result;
  const std::size_t size = recording.size();
  const auto [low, high] = std::ranges::minmax(recording.displacement);
  result.stroke = 0.5 * (high - low);
  result.centre = 0.5 * (high + low);
  for (const double v : recording.velocity) {
    result.speed = std::max(result.speed, std::fabs(v));
  }
  // A sign change counts once the speed has been real on both sides: noise around rest is no reversal.
  const double quiet = 0.02 * result.speed;
  int direction = 0;
  double distance = 0.0;
  double turned = recording.time[0];
  double travelled = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const double v = recording.velocity[n];
    if (n > 0) {
      const double step = std::fabs(recording.displacement[n] - recording.displacement[n - 1]);
      distance += step;
      travelled += step;
    }
    const int sign = v > quiet ? 1 : (v < -quiet ? -1 : 0);
    if (sign != 0 && sign != direction) {
      direction = sign;
      distance = 0.0;
      turned = recording.time[n];
    }
    result.since_reversal_distance.push_back(distance);
    result.since_reversal_time.push_back(recording.time[n] - turned);
    result.travelled.push_back(travelled);
  }
  if (!drive_varies(recording)) {
    return result;
  }
  const auto [least, most] = std::ranges::minmax(recording.drive);
  const double range = most - least;
  double settled = recording.drive[0];
  double changed = recording.time[0] - 1e3;
  double jump = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    if (std::fabs(recording.drive[n] - settled) > 0.05 * range) {
      jump = recording.drive[n] - settled;
      settled = recording.drive[n];
      changed = recording.time[n];
    }
    result.since_drive_change.push_back(recording.time[n] - changed);
    result.drive_step.push_back(jump);
  }
  return result;
}

}  // namespace hysteron
