#include "core/earlier_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/number_text.hpp"
#include "core/recording.hpp"

namespace hysteron {
namespace {

// Stretches of one recording, and how long one may be for its age when older ones are put together: at its middle, what
// fades with a time constant of a fifth of its age is then still within a hundredth.
constexpr std::size_t stretches = 16;
constexpr double longest_for_its_age = 0.1;

// s that a start may be off: clocks are told in seconds, or all in whole minutes. Files that were written one after the
// other, with the time of that, overlap by more.
double clock_error(const std::vector<Recording>& recordings) {
  constexpr double minute = 60.0;
  const auto whole = [](const Recording& recording) { return std::fmod(*recording.started, minute) == 0.0; };
  return std::ranges::all_of(recordings, whole) ? minute : 1.0;
}

double duration(const Recording& recording) { return recording.time.back() - recording.time.front(); }

struct Stretch {
  double from;  // s of the clock
  double to;
  double work;
};

// Equal parts of the time of a recording.
std::vector<Stretch> stretches_of(const Recording& recording) {
  std::vector<Stretch> result;
  const std::size_t steps = recording.size() - 1;
  const std::size_t parts = std::min(stretches, steps);
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t first = k * steps / parts;
    const std::size_t last = (k + 1) * steps / parts;
    Stretch stretch{*recording.started + recording.time[first] - recording.time.front(),
                    *recording.started + recording.time[last] - recording.time.front(), 0.0};
    for (std::size_t n = first; n < last; ++n) {
      stretch.work += 0.5 * (recording.force[n] + recording.force[n + 1]) *
                      (recording.displacement[n + 1] - recording.displacement[n]);
    }
    result.push_back(stretch);
  }
  return result;
}

std::vector<EarlierWork> seen_from(double start, const std::vector<Stretch>& before) {
  std::vector<EarlierWork> result;
  double from = 0.0;  // of the last one
  for (const Stretch& stretch : before) {
    const double ago = std::max(start - 0.5 * (stretch.from + stretch.to), 0.0);
    if (!result.empty() && stretch.to - from <= longest_for_its_age * (start - stretch.to)) {
      EarlierWork& last = result.back();
      const double both = last.work + stretch.work;
      // The mean age by work, where both are losses; what springs give back has no age of its own.
      last.ago = last.work > 0.0 && stretch.work > 0.0 ? (last.ago * last.work + ago * stretch.work) / both
                                                       : 0.5 * (last.ago + ago);
      last.work = both;
    } else {
      result.push_back({ago, stretch.work});
      from = stretch.from;
    }
  }
  return result;
}

}  // namespace

std::optional<WrongStart> carry_work(std::vector<Recording>& recordings) {
  for (Recording& recording : recordings) {
    recording.earlier.clear();
  }
  const auto counts = [](const Recording& recording) {
    return recording.started && recording.timed && recording.size() > 1 && recording.force.size() == recording.size();
  };
  if (recordings.size() < 2 || !std::ranges::all_of(recordings, counts)) {
    return std::nullopt;
  }
  std::vector<std::size_t> order(recordings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return *recordings[k].started; });
  const double error = clock_error(recordings);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Recording& before = recordings[order[k - 1]];
    const Recording& after = recordings[order[k]];
    if (*after.started + error < *before.started + duration(before) || *after.started == *before.started) {
      return WrongStart{after.file, "was started " + number_text(*after.started - *before.started) + " s after " +
                                        before.file + ", which takes " + number_text(duration(before)) +
                                        " s: the starts cannot be those of the recordings, and heat and wear are not "
                                        "carried from one to the next"};
    }
  }
  std::vector<Stretch> before;
  for (const std::size_t k : order) {
    recordings[k].earlier = seen_from(*recordings[k].started, before);
    const std::vector<Stretch> own = stretches_of(recordings[k]);
    before.insert(before.end(), own.begin(), own.end());
  }
  return std::nullopt;
}

}  // namespace hysteron
