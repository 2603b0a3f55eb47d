#include "diagnose/residual/contrast_track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/drive.hpp"
#include "core/extent.hpp"
#include "core/robust.hpp"
#include "io/velocity.hpp"

namespace hysteron::contrast {
namespace {

constexpr std::size_t fewest_samples = 50;  // of a recording that is looked at
constexpr double quiet_speed = 0.02;    // of the largest: below it nothing moves, and no sign of the velocity counts
constexpr double shortest_hold = 0.2;   // s
constexpr double jump_of_drive = 0.05;  // of its range, from one sample to the next but one
constexpr double longest_step = 5.0;    // of the median time between samples; longer ones are gaps

// Slope over time by central differences.
Values slope_of(const Values& time, const Values& values) {
  const std::size_t size = values.size();
  Values result(size);
  for (std::size_t n = 0; n < size; ++n) {
    const std::size_t before = n > 0 ? n - 1 : 0;
    const std::size_t after = std::min(n + 1, size - 1);
    result[n] = (values[after] - values[before]) / (time[after] - time[before]);
  }
  return result;
}

bool all_finite(const Values& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// A sign of the velocity counts once it was real; the reversal is where the displacement was furthest before that.
void find_reversals(Track& track) {
  const std::size_t size = track.x.size();
  const double quiet = quiet_speed * track.speed;
  std::vector<std::size_t> reversals;
  double direction = 0.0;
  std::size_t last_moving = 0;
  for (std::size_t n = 0; n < size; ++n) {
    const double sign = track.v[n] > quiet ? 1.0 : (track.v[n] < -quiet ? -1.0 : 0.0);
    if (sign == 0.0) {
      continue;
    }
    if (sign != direction) {
      std::size_t furthest = n;
      for (std::size_t k = direction == 0.0 ? n : last_moving; k < n; ++k) {
        if (direction * (track.x[k] - track.x[furthest]) > 0.0) {
          furthest = k;
        }
      }
      direction = sign;
      reversals.push_back(furthest);
    }
    last_moving = n;
  }
  track.half_cycle.assign(size, 0);
  track.direction.assign(size, 0.0);
  track.since.assign(size, 0.0);
  track.at_reversal.assign(size, track.simulated.front());
  for (std::size_t k = 0; k < reversals.size(); ++k) {
    const Stretch part{reversals[k], k + 1 < reversals.size() ? reversals[k + 1] : size};
    double sign = 0.0;
    for (std::size_t n = part.first; n < part.end && sign == 0.0; ++n) {
      sign = std::fabs(track.v[n]) > quiet ? std::copysign(1.0, track.v[n]) : 0.0;
    }
    for (std::size_t n = part.first; n < part.end; ++n) {
      track.half_cycle[n] = k + 1;
      track.direction[n] = sign;
      track.since[n] = std::fabs(track.x[n] - track.x[part.first]);
      track.at_reversal[n] = track.simulated[part.first];
    }
    // The first is a start, which is no reversal; the last may be cut off.
    if (k > 0 && part.first >= track.from) {
      track.half_cycles.push_back(part);
    }
  }
  Values times;
  for (std::size_t k = 2; k < reversals.size(); ++k) {
    times.push_back(track.time[reversals[k]] - track.time[reversals[k - 1]]);
  }
  track.period = times.empty() ? 0.0 : 2.0 * median_of(times);
}

void find_holds(Track& track) {
  const std::size_t size = track.x.size();
  const double quiet = quiet_speed * track.speed;
  for (std::size_t n = track.from; n < size;) {
    if (std::fabs(track.v[n]) >= quiet) {
      ++n;
      continue;
    }
    std::size_t end = n;
    while (end < size && std::fabs(track.v[end]) < quiet &&
           std::fabs(track.x[end] - track.x[n]) < quiet_speed * track.stroke) {
      ++end;
    }
    if (track.time[end - 1] - track.time[n] >= shortest_hold) {
      double before = 0.0;
      for (std::size_t k = n; k-- > 0 && before == 0.0;) {
        before = std::fabs(track.v[k]) > quiet ? std::copysign(1.0, track.v[k]) : 0.0;
      }
      track.holds.push_back({{n, end}, before});
    }
    n = end;
  }
}

std::optional<Track> track_of(const Recording& recording, const Residual& residual) {
  const std::size_t size = recording.size();
  if (size < residual.from + fewest_samples || residual.force.size() != size || recording.force.size() != size ||
      recording.velocity.size() != size || !all_finite(residual.force)) {
    return std::nullopt;
  }
  Track track;
  track.from = residual.from;
  track.time = recording.time;
  track.x = recording.displacement;
  track.v = recording.velocity;
  track.a = recording.derived_acceleration.size() == size ? recording.derived_acceleration
                                                          : slope_of(recording.time, recording.velocity);
  track.drive = quiet_drive(recording.drive);
  track.earlier = recording.earlier;
  track.force = recording.force;
  track.simulated = recording.force;
  track.missing.assign(size, 0.0);
  for (std::size_t n = residual.from; n < size; ++n) {
    track.simulated[n] += residual.force[n];
    track.missing[n] = -residual.force[n];
  }
  const auto [low, high] = std::ranges::minmax(track.x);
  track.stroke = 0.5 * (high - low);
  track.speed = peak_of(track.v);
  track.peak = peak_of(track.simulated);
  const double measured_peak = peak_of(track.force);
  if (!(track.stroke > 0.0) || !(track.speed > 0.0) || !(measured_peak > 0.0) || !(track.peak > 0.0) ||
      !all_finite(track.force) || !all_finite(track.x) || !all_finite(track.v) || !all_finite(track.a)) {
    return std::nullopt;
  }
  Values steps;
  for (std::size_t n = 1; n < size; ++n) {
    steps.push_back(track.time[n] - track.time[n - 1]);
  }
  const double longest = longest_step * median_of(steps);
  track.duration.assign(size, 0.0);
  for (std::size_t n = 1; n < size; ++n) {
    const double half = 0.5 * std::min(steps[n - 1], longest);
    track.duration[n - 1] += half;
    track.duration[n] += half;
  }
  track.weight = 1.0 / (measured_peak * measured_peak * (track.time.back() - track.time[track.from]));
  track.travelled.assign(size, 0.0);
  track.work.assign(size, 0.0);
  for (std::size_t n = 1; n < size; ++n) {
    track.travelled[n] = track.travelled[n - 1] + std::fabs(track.x[n] - track.x[n - 1]);
    track.work[n] =
        track.work[n - 1] + 0.5 * (track.force[n] * track.v[n] + track.force[n - 1] * track.v[n - 1]) * steps[n - 1];
  }
  track.slope = slope_of(track.time, track.simulated);
  find_reversals(track);
  find_holds(track);
  const auto [least, most] =
      track.drive.empty() ? std::ranges::minmax_result<double>{0.0, 0.0} : std::ranges::minmax(track.drive);
  const double jump = std::max(jump_of_drive * (most - least), 1e-9);
  const double quiet = quiet_speed * track.speed;
  track.stiff.assign(size, 0.0);
  for (std::size_t n = 0; n < size; ++n) {
    const std::size_t before = n > 0 ? n - 1 : 0;
    const std::size_t after = std::min(n + 1, size - 1);
    const bool jumps = !track.drive.empty() && std::fabs(track.drive[after] - track.drive[before]) > jump;
    track.stiff[n] = jumps ? 0.0 : track.slope[n] * std::fabs(track.v[n]) / (track.v[n] * track.v[n] + quiet * quiet);
  }
  if (recording.velocity_measured) {
    track.slip = derive_velocity(recording.time, recording.displacement);
    for (std::size_t n = 0; n < size; ++n) {
      track.slip[n] = track.v[n] - track.slip[n];
    }
    if (!all_finite(track.slip)) {
      track.slip.clear();
    }
  }
  return track;
}

}  // namespace

std::vector<Track> tracks_of(std::span<const Recording> recordings, std::span<const Residual> residuals,
                             std::span<const std::size_t> motions) {
  std::vector<Track> result;
  for (std::size_t k = 0; k < std::min(recordings.size(), residuals.size()); ++k) {
    if (std::optional<Track> track = track_of(recordings[k], residuals[k])) {
      track->recording = k;
      track->motion = motions.empty() ? k : motions[k];
      result.push_back(std::move(*track));
    }
  }
  return result;
}

}  // namespace hysteron::contrast
