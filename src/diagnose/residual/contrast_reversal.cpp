// After a reversal: travel over which there is no force. A play holds it at zero for as many millimetres at every
// speed, amplitude and force. The travel w(e) in which the force crosses from -e to e of its peak is gap + e b with any
// law that is straight there; the intercept of two bands is the gap, and an elastic element, whose travel grows with
// the force, has none. The base model's own intercept is subtracted.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/drive.hpp"
#include "diagnose/residual/contrast_parts.hpp"

namespace hysteron::contrast {
namespace {

constexpr double narrow = 0.08;     // of the peak force, half width of the inner band
constexpr double widest = 0.12;     // of the peak force, half width of an inner band above which nothing is told
constexpr double over_noise = 4.0;  // standard deviations of the noise that the inner band has
constexpr double ratio = 3.0;       // of the outer band to the inner
constexpr double least_peak = 0.3;  // of the recording's peak, that a force reaches on both sides of a reversal

// A reversal with the samples of the force's extremes before and after it.
struct Crossing {
  Stretch samples;
  double direction = 0.0;
};

// Samples from the largest force of one half-cycle to that of the next.
std::vector<Crossing> crossings_of(const Track& track) {
  std::vector<Crossing> result;
  const auto extreme = [&](const Stretch& part, double direction) {
    std::size_t best = part.first;
    for (std::size_t n = part.first; n < part.end; ++n) {
      if (direction * (track.simulated[n] - track.simulated[best]) > 0.0) {
        best = n;
      }
    }
    return best;
  };
  for (std::size_t k = 0; k + 1 < track.half_cycles.size(); ++k) {
    const Stretch& before = track.half_cycles[k];
    const Stretch& after = track.half_cycles[k + 1];
    const double direction = track.direction[after.first];
    const std::size_t first = extreme(before, -direction);
    const std::size_t end = extreme(after, direction);
    if (direction * track.direction[before.first] < 0.0 && before.end == after.first && first < end &&
        -direction * track.simulated[first] > least_peak * track.peak &&
        direction * track.simulated[end] > least_peak * track.peak) {
      result.push_back({{first, end + 1}, direction});
    }
  }
  return result;
}

// Path at which the force passes `level` for the last time before, or the first time after, `at`; linear between
// samples.
template <class Force>
std::optional<double> path_at(const Track& track, const Crossing& crossing, Force force, double level, bool first) {
  const auto relative = [&](std::size_t n) { return crossing.direction * force(n) - level; };
  std::optional<double> result;
  for (std::size_t n = crossing.samples.first + 1; n < crossing.samples.end; ++n) {
    const double before = relative(n - 1);
    const double after = relative(n);
    if (before < 0.0 && after >= 0.0) {
      const double part = before / (before - after);
      result = track.travelled[n - 1] + part * (track.travelled[n] - track.travelled[n - 1]);
      if (first) {
        return result;
      }
    }
  }
  return result;
}

template <class Force>
std::optional<double> gap(const Track& track, const Crossing& crossing, Force force, double band) {
  std::array<double, 2> width{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double level = (k == 0 ? band : ratio * band) * track.peak;
    const std::optional<double> from = path_at(track, crossing, force, -level, false);
    const std::optional<double> to = path_at(track, crossing, force, level, true);
    if (!from || !to) {
      return std::nullopt;
    }
    width[k] = *to - *from;
  }
  return (ratio * width[0] - width[1]) / (ratio - 1.0);
}

struct Scene {
  const Track* track;
  double band = 0.0;
  std::vector<Crossing> crossings;
  std::vector<std::optional<double>> simulated;  // gap of the base model
};

std::vector<Event> gaps(std::span<const Scene> scenes, std::optional<std::size_t> placebo) {
  std::vector<Event> result;
  for (const Scene& scene : scenes) {
    const Track& track = *scene.track;
    const std::size_t size = track.time.size() - track.from;
    const double step = (track.time.back() - track.time[track.from]) / static_cast<double>(size - 1);
    const std::size_t shift = placebo ? placebo_shift(*placebo, track.recording, size, track.period / step) : 0;
    const auto force = [&](std::size_t n) {
      const std::size_t from = n - track.from + shift;
      return track.simulated[n] + track.missing[track.from + (from < size ? from : from - size)];
    };
    for (std::size_t k = 0; k < scene.crossings.size(); ++k) {
      const std::optional<double> found = gap(track, scene.crossings[k], force, scene.band);
      if (found && scene.simulated[k]) {
        result.push_back({track.recording, *found - *scene.simulated[k], track.motion});
      }
    }
  }
  return result;
}

}  // namespace

void add_reversal_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  std::vector<Scene> scenes;
  for (const Track& track : tracks) {
    Scene scene{&track, std::max(narrow, over_noise * drive_noise(track.force) / track.peak), crossings_of(track), {}};
    if (scene.band > widest || scene.crossings.empty()) {
      continue;
    }
    for (const Crossing& crossing : scene.crossings) {
      scene.simulated.push_back(gap(
          track, crossing, [&](std::size_t n) { return track.simulated[n]; }, scene.band));
    }
    scenes.push_back(std::move(scene));
  }
  std::optional<Contrast> found = pooled(ContrastKind::reversal_travel, gaps(scenes, std::nullopt));
  if (!found) {
    return;
  }
  Values sizes;
  for (std::size_t p = 0; p < placebos; ++p) {
    sizes.push_back(std::fabs(mean_of(gaps(scenes, p))));
  }
  judge(*found, std::fabs(found->value), sizes);
  result.push_back(std::move(*found));
}

}  // namespace hysteron::contrast
