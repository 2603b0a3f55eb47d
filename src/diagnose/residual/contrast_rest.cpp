// Where the motion stops and stays: relaxation of the force. Where it goes on after a pause: what the pause gave back.
#include <algorithm>
#include <cmath>

#include "diagnose/residual/contrast_parts.hpp"

namespace hysteron::contrast {
namespace {

// Seconds after the stop: the force once any lag of the channels is over, and later.
constexpr double early_from = 0.005;
constexpr double early_to = 0.02;
constexpr double late_from = 0.08;
constexpr double late_to = 0.2;
// A path this many times the net displacement, and of this share of the stroke, is noise of the recorded displacement:
// the hysteresis of a base model relaxes on it as no damper does. What it does then is not subtracted.
constexpr double jitter = 2.0;
constexpr double least_jitter = 3e-3;

bool jitters(const Track& track, const Hold& hold) {
  double path = 0.0;
  std::size_t n = hold.samples.first;
  for (; n + 1 < hold.samples.end && track.time[n] - track.time[hold.samples.first] < late_to; ++n) {
    path += std::fabs(track.v[n]) * (track.time[n + 1] - track.time[n]);
  }
  return path > std::max(least_jitter * track.stroke, jitter * std::fabs(track.x[n] - track.x[hold.samples.first]));
}

// Empty where no sample falls between: recordings of slow motions are sampled more coarsely than the early force lasts.
std::optional<double> mean_between(const Track& track, const Values& values, const Hold& hold, std::size_t shift,
                                   double from, double to) {
  const std::size_t first = hold.samples.first;
  const std::size_t size = hold.samples.end - first;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const double since = track.time[first + n] - track.time[first];
    if (since >= from && since <= to) {
      sum += values[first + (n + shift) % size];
      count += 1.0;
    }
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

// What relaxes, as a share of the peak force, of a residual that is moved within the hold.
std::optional<double> relaxation(const Track& track, const Hold& hold, std::size_t shift) {
  const Values& force = jitters(track, hold) ? track.force : track.missing;
  const std::optional<double> early = mean_between(track, force, hold, shift, early_from, early_to);
  const std::optional<double> late = mean_between(track, force, hold, shift, late_from, late_to);
  return early && late ? std::optional(hold.direction * (*early - *late) / track.peak) : std::nullopt;
}

std::vector<Event> relaxations(std::span<const Track> tracks, std::optional<std::size_t> placebo) {
  std::vector<Event> result;
  for (const Track& track : tracks) {
    for (std::size_t k = 0; k < track.holds.size(); ++k) {
      const Hold& hold = track.holds[k];
      if (hold.direction == 0.0) {
        continue;
      }
      std::size_t shift = 0;
      double sign = 1.0;
      if (placebo) {
        shift = placebo_shift(*placebo, 1000 * track.recording + k, hold.samples.end - hold.samples.first, 0.0);
        sign = placebo_sign(*placebo, track.recording, k);
      }
      if (const std::optional<double> size = relaxation(track, hold, shift)) {
        result.push_back({track.recording, sign * *size, track.motion});
      }
    }
  }
  return result;
}

// Least pause in s, and half-cycles before and after it that are compared.
constexpr double least_pause = 1.0;
constexpr std::size_t compared = 2;

// Factor of the simulated force that each half-cycle lacks.
Values gains_of(const Track& track) {
  Values result;
  for (const Stretch& part : track.half_cycles) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t n = part.first; n < part.end; ++n) {
      product += track.missing[n] * track.simulated[n];
      square += track.simulated[n] * track.simulated[n];
    }
    result.push_back(square > 0.0 ? product / square : 0.0);
  }
  return result;
}

std::vector<Event> recoveries(std::span<const Track> tracks, std::optional<std::size_t> placebo) {
  std::vector<Event> result;
  for (const Track& track : tracks) {
    Values gains;
    for (const Hold& hold : track.holds) {
      if (track.time[hold.samples.end - 1] - track.time[hold.samples.first] < least_pause) {
        continue;
      }
      // Number of half-cycles that are over, and of the first that begins after the pause.
      std::size_t before = 0;
      std::size_t after = 0;
      for (const Stretch& part : track.half_cycles) {
        before += part.end <= hold.samples.first ? 1 : 0;
        after += part.first < hold.samples.end ? 1 : 0;
      }
      if (before < compared || after + compared > track.half_cycles.size()) {
        continue;
      }
      if (gains.empty()) {
        gains = gains_of(track);
      }
      const std::size_t shift = placebo ? placebo_shift(*placebo, track.recording, gains.size(), 0.0) : 0;
      double change = 0.0;
      for (std::size_t k = 0; k < compared; ++k) {
        change += gains[(after + k + shift) % gains.size()] - gains[(before - 1 - k + shift) % gains.size()];
      }
      result.push_back({track.recording, change / static_cast<double>(compared), track.motion});
    }
  }
  return result;
}

}  // namespace

void add_rest_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  const auto add = [&](ContrastKind kind, auto&& events_of) {
    std::optional<Contrast> found = pooled(kind, events_of(tracks, std::nullopt));
    if (!found) {
      return;
    }
    Values sizes;
    for (std::size_t p = 0; p < placebos; ++p) {
      sizes.push_back(std::fabs(mean_of(events_of(tracks, std::optional(p)))));
    }
    judge(*found, std::fabs(found->value), sizes);
    result.push_back(std::move(*found));
  };
  add(ContrastKind::rest_relaxation, relaxations);
  add(ContrastKind::pause_recovery, recoveries);
}

}  // namespace hysteron::contrast
