#include "diagnose/residual/contrast_view.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/residual/contrast_track.hpp"

namespace hysteron {
namespace {

using contrast::Hold;
using contrast::Stretch;
using contrast::Track;

enum class Part { cycle, first_cycles, stop, pause, step, whole };

struct Look {
  ForceOver over;
  Part part;
};

Look look_at(ContrastKind kind) {
  using enum ContrastKind;
  switch (kind) {
    case rest_relaxation:
      return {ForceOver::time, Part::stop};
    case pause_recovery:
      return {ForceOver::time, Part::pause};
    case drive_lag:
      return {ForceOver::time, Part::step};
    case first_travel:
      return {ForceOver::time, Part::first_cycles};
    case drive_memory:
    case energy_fade:
    case carried_fade:
    case drift:
      return {ForceOver::time, Part::whole};
    case force_delay:
    case velocity_delay:
    case acceleration:
      return {ForceOver::time, Part::cycle};
    case viscous:
    case speed_bend:
    case low_speed:
    case dry_friction:
    case direction:
    case drive_bend:
      return {ForceOver::velocity, Part::cycle};
    default:
      return {ForceOver::displacement, Part::cycle};
  }
}

Stretch whole(const Track& track) { return {track.from, track.time.size()}; }

// Two half-cycles that follow one another, those of the widest motion; the last of equal ones.
Stretch cycle(const Track& track) {
  constexpr double as_wide = 0.98;
  Stretch best = whole(track);
  double widest = 0.0;
  for (std::size_t k = 0; k + 1 < track.half_cycles.size(); ++k) {
    const Stretch both{track.half_cycles[k].first, track.half_cycles[k + 1].end};
    const auto [low, high] = std::minmax_element(track.x.begin() + static_cast<std::ptrdiff_t>(both.first),
                                                 track.x.begin() + static_cast<std::ptrdiff_t>(both.end));
    if (*high - *low > as_wide * widest) {
      widest = std::max(widest, *high - *low);
      best = both;
    }
  }
  return best;
}

// Samples within these seconds before and after one of them.
Stretch around(const Track& track, std::size_t sample, double before, double after) {
  Stretch result{sample, sample + 1};
  while (result.first > track.from && track.time[sample] - track.time[result.first - 1] <= before) {
    --result.first;
  }
  while (result.end < track.time.size() && track.time[result.end] - track.time[sample] <= after) {
    ++result.end;
  }
  return result;
}

Stretch stretch_of(const Track& track, Part part) {
  constexpr double before_stop = 0.1;  // s
  constexpr double after_stop = 0.4;
  constexpr double before_step = 0.05;
  constexpr double after_step = 0.2;
  switch (part) {
    case Part::whole:
      return whole(track);
    case Part::first_cycles:
      return track.half_cycles.size() < 4 ? whole(track) : Stretch{track.from, track.half_cycles[3].end};
    case Part::stop:
    case Part::pause: {
      const auto stop = std::ranges::find_if(track.holds, [](const Hold& hold) { return hold.direction != 0.0; });
      if (stop == track.holds.end()) {
        return cycle(track);
      }
      if (part == Part::stop) {
        return around(track, stop->samples.first, before_stop, after_stop);
      }
      const double length = track.time[stop->samples.end - 1] - track.time[stop->samples.first];
      return around(track, stop->samples.first, track.period, length + track.period);
    }
    case Part::step: {
      std::size_t at = 0;
      double largest = 0.0;
      for (std::size_t n = track.from + 1; n < track.drive.size(); ++n) {
        const double step = std::fabs(track.drive[n] - track.drive[n - 1]);
        if (step > largest) {
          largest = step;
          at = n;
        }
      }
      return largest > 0.0 ? around(track, at, before_step, after_step) : cycle(track);
    }
    case Part::cycle:
      break;
  }
  return cycle(track);
}

// The track that is missed most, in the weights of the cost; of a contrast one of those whose own value has
// its sign.
const Track& most_missed(std::span<const Track> tracks, const Contrast* contrast) {
  const auto agrees = [&](const Track& track) {
    return contrast == nullptr || std::ranges::any_of(contrast->of_recordings, [&](const ContrastOfRecording& one) {
             return one.recording == track.recording && one.value * contrast->value > 0.0;
           });
  };
  const Track* best = nullptr;
  double most = -1.0;
  for (const Track& track : tracks) {
    double squares = 0.0;
    for (std::size_t n = track.from; n < track.missing.size(); ++n) {
      squares += track.weight * track.duration[n] * track.missing[n] * track.missing[n];
    }
    if (squares > most && agrees(track)) {
      most = squares;
      best = &track;
    }
  }
  return best == nullptr ? tracks.front() : *best;
}

}  // namespace

std::string_view word_of(ForceOver over) {
  switch (over) {
    case ForceOver::time:
      return "time";
    case ForceOver::velocity:
      return "velocity";
    case ForceOver::displacement:
      break;
  }
  return "displacement";
}

std::optional<ContrastView> view_of(const Contrast* contrast, std::span<const Recording> recordings,
                                    std::span<const Residual> residuals) {
  const std::vector<Track> tracks = contrast::tracks_of(recordings, residuals);
  if (tracks.empty()) {
    return std::nullopt;
  }
  const Track& track = most_missed(tracks, contrast);
  const Look look = contrast == nullptr ? Look{ForceOver::displacement, Part::cycle} : look_at(contrast->kind);
  const Stretch part = stretch_of(track, look.part);
  return ContrastView{track.recording, track.time[part.first], track.time[part.end - 1], look.over};
}

}  // namespace hysteron
