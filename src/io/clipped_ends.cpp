#include "io/clipped_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/extent.hpp"
#include "core/robust.hpp"
#include "io/saturation.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A plateau is four standard deviations of the noise wide, or as wide as two steps of a converter and half a step on
// either side, or a thousandth of the span where there is no noise.
constexpr double deviations_wide = 4.0;
constexpr double steps_wide = 2.5;
constexpr double part_of_span_wide = 1e-3;
// So many samples are at it, so many running at once, and no more than a few beyond: two deviations leave one of forty
// there.
constexpr double least_share = 0.02;
constexpr std::size_t least_run = 8;
constexpr double most_beyond = 0.05;
// Of the samples within so many widths before it (a fiftieth of the span at least) there are so many fewer. Before the
// crest of a sine, and of all that is round, there are more than at it.
constexpr double widths_before = 2.0;
constexpr double near_the_end = 0.02;
constexpr double most_before = 0.25;
// Levels of one end are this part of a width apart, half a deviation of the noise: the mean of a hundred samples is
// known better. Of 270 campaigns, of dampers measured and simulated, that are not cut off the nearest plateaus at the
// end of what a campaign reached were a fifth of a width apart.
constexpr double apart = 0.125;
constexpr std::size_t fewest_recordings = 2;
// A yield force follows the drive; this is another drive.
constexpr double another_drive = 0.05;
// Where it rests in most recordings the force leaves its end while the rod goes on by this part of its fastest speed,
// in most plateaus; friction is left where the rod turns round.
constexpr double goes_on = 0.2;
// Travel with less than this part of the end's force, behind a plateau over before it: as long without a void, and
// longer with one, which is as long as what the rod went while the force was limited.
constexpr double no_force = 0.1;
constexpr double longer_travel = 1.5;
// The force falls by this part of its span in the last three quarters of a plateau of the displacement
// (io/channel_faults.cpp).
constexpr double turns = 0.25;

// Samples [first, end) at the level, one or two that noise took out of it aside.
struct Run {
  std::size_t first = 0;
  std::size_t end = 0;
};

struct Plateau {
  double level = 0.0;  // of the sign looked at: the end is a largest value
  double width = 0.0;
  double share = 0.0;
  std::vector<Run> runs;
};

std::vector<Run> long_runs(const std::vector<double>& values, double low, double high) {
  // Two deviations of the noise leave five samples of a hundred outside, three running next to never.
  constexpr std::size_t most_out = 2;
  std::vector<Run> runs;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] < low || values[n] > high) continue;
    if (!runs.empty() && n - runs.back().end <= most_out) {
      runs.back().end = n + 1;
    } else {
      runs.push_back({n, n + 1});
    }
  }
  std::erase_if(runs, [](const Run& run) { return run.end - run.first < least_run; });
  return runs;
}

std::optional<Plateau> plateau_of(const std::vector<double>& time, const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  const double span = sorted.back() - sorted.front();
  if (!(span > 0.0)) return std::nullopt;
  Plateau result;
  result.width = std::max(
      {deviations_wide * channel_noise(time, values), steps_wide * channel_quantum(values), part_of_span_wide * span});
  // The densest stretch of that width near the end. Noise, on top of the level, goes beyond it by one width at most.
  const auto begin = std::ranges::upper_bound(sorted, sorted.back() - 4.0 * result.width);
  auto densest = std::pair(begin, begin);
  for (auto first = begin, last = begin; first != sorted.end(); ++first) {
    while (last != sorted.end() && *last <= *first + result.width) ++last;
    if (last - first > densest.second - densest.first) densest = {first, last};
  }
  result.level = *(densest.first + (densest.second - densest.first) / 2);
  const double low = result.level - 0.5 * result.width;
  const double high = result.level + 0.5 * result.width;
  const double further = std::max(widths_before * result.width, near_the_end * span);
  // A force of friction has no more than its two levels, and its jumps between few samples count as noise: so wide a
  // plateau leaves nothing before it to be compared with.
  if (!(low - further > sorted.front())) return std::nullopt;
  const auto count = [&](double from, double to) {
    return static_cast<double>(std::ranges::upper_bound(sorted, to) - std::ranges::lower_bound(sorted, from));
  };
  const double at = count(low, high);
  result.share = at / static_cast<double>(values.size());
  result.runs = long_runs(values, low, high);
  const bool ends_there = result.share >= least_share && !result.runs.empty() &&
                          count(low - further, low) < most_before * at && count(high, sorted.back()) < most_beyond * at;
  return ends_there ? std::optional(result) : std::nullopt;
}

// What is looked at: `sign` 1 for the largest values of the channel, -1 for the smallest.
struct Channel {
  std::vector<double> Recording::*values;
  double sign;
  std::vector<double> of(const Recording& recording) const {
    std::vector<double> result = recording.*values;
    for (double& value : result) value *= sign;
    return result;
  }
};

struct Resting {
  std::size_t recording;
  Plateau plateau;
};

// The plateaus of all recordings that have one where the campaign's largest value is. Nothing where these are few, not
// at one level, or not at the end.
std::vector<Resting> resting_at_one_end(const std::vector<Recording>& recordings, const Channel& channel) {
  std::vector<Resting> resting;
  double largest = 0.0;
  bool any = false;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    std::vector<double> values = channel.of(recordings[k]);
    if (values.size() < 2 * least_run) continue;
    if (auto plateau = plateau_of(recordings[k].time, values)) resting.push_back({k, std::move(*plateau)});
    // Two outliers are no end.
    std::ranges::nth_element(values, values.end() - 3);
    const double third = *(values.end() - 3);
    largest = any ? std::max(largest, third) : third;
    any = true;
  }
  if (resting.size() < fewest_recordings) return {};
  const auto level = [](const Resting& one) { return one.plateau.level; };
  const auto [low, high] = std::ranges::minmax(resting, {}, level);
  double narrow = resting.front().plateau.width;
  double wide = 0.0;
  for (const Resting& one : resting) {
    narrow = std::min(narrow, one.plateau.width);
    wide = std::max(wide, one.plateau.width);
  }
  const bool one_level = high.plateau.level - low.plateau.level <= apart * narrow;
  return one_level && largest <= high.plateau.level + wide ? resting : std::vector<Resting>{};
}

ClippedEnd end_of(const std::vector<Resting>& resting, double sign) {
  ClippedEnd result;
  std::vector<double> levels;
  for (const Resting& one : resting) {
    levels.push_back(sign * one.plateau.level);
    result.recordings.push_back(one.recording);
    result.share = std::max(result.share, one.plateau.share);
  }
  result.level = median_of(std::move(levels));
  return result;
}

bool drives_differ(const std::vector<Recording>& recordings, const std::vector<Resting>& resting) {
  double low = peak_of(recordings[resting.front().recording].drive);
  double high = low;
  for (const Resting& one : resting) {
    const double drive = peak_of(recordings[one.recording].drive);
    low = std::min(low, drive);
    high = std::max(high, drive);
  }
  return high - low > another_drive * high;
}

// Friction reaches its end in every recording, even where too few samples show that it rests there.
bool some_stay_short(const std::vector<Recording>& recordings, const std::vector<Resting>& resting, double sign) {
  double level = resting.front().plateau.level;
  double width = 0.0;
  for (const Resting& one : resting) {
    level = std::min(level, one.plateau.level);
    width = std::max(width, one.plateau.width);
  }
  return std::ranges::any_of(recordings, [&](const Recording& one) {
    const auto [low, high] = std::ranges::minmax(one.force);
    return (sign > 0.0 ? high : -low) < level - width;
  });
}

// Whether the rod goes on, the way that it went, where most plateaus are left: between the last sample at the level and
// the first one out of it, so that coarse samples do not hide that it turned round.
bool rod_goes_on(const std::vector<Recording>& recordings, const std::vector<Resting>& resting) {
  std::size_t on = 0;
  std::size_t all = 0;
  for (const Resting& one : resting) {
    const std::vector<double>& velocity = recordings[one.recording].velocity;
    const double enough = goes_on * peak_of(velocity);
    for (const Run& run : one.plateau.runs) {
      if (run.end == velocity.size()) continue;
      const double way = std::copysign(1.0, velocity[(run.first + run.end) / 2]);
      const double last = way * velocity[run.end - 1];
      const double next = way * velocity[run.end];
      ++all;
      on += next > 0.0 && 0.5 * (last + next) > enough ? 1 : 0;
    }
  }
  return 2 * on > all;
}

// How far the rod goes from `from` on, forwards or backwards, with less than `enough` of the force either way, once the
// force is that small; nothing where it never is, or does not become large again.
std::optional<double> travel_without_force(const Recording& recording, std::size_t from, bool forwards, double enough) {
  std::optional<double> began;
  const std::size_t left = forwards ? recording.size() - 1 - from : from;
  for (std::size_t k = 0; k <= left; ++k) {
    const std::size_t n = forwards ? from + k : from - k;
    const bool small = std::fabs(recording.force[n]) < enough;
    const double at = recording.displacement[n];
    if (!began && small) began = at;
    if (began && !small) return std::fabs(at - *began);
  }
  return std::nullopt;
}

bool void_follows(const std::vector<Recording>& recordings, const std::vector<Resting>& resting) {
  std::vector<double> before;
  std::vector<double> behind;
  for (const Resting& one : resting) {
    const Recording& recording = recordings[one.recording];
    const double enough = no_force * std::fabs(one.plateau.level);
    for (const Run& run : one.plateau.runs) {
      const auto one_before = travel_without_force(recording, run.first, false, enough);
      const auto one_behind = travel_without_force(recording, run.end - 1, true, enough);
      if (!one_before || !one_behind) continue;
      before.push_back(*one_before);
      behind.push_back(*one_behind);
    }
  }
  return before.empty() || median_of(std::move(behind)) > longer_travel * median_of(std::move(before));
}

// Whether the force turns round in most plateaus of the displacement.
bool force_turns(const std::vector<Recording>& recordings, const std::vector<Resting>& resting, double sign) {
  std::size_t turned = 0;
  std::size_t all = 0;
  for (const Resting& one : resting) {
    const std::vector<double>& force = recordings[one.recording].force;
    const double enough = turns * span_of(force);
    for (const Run& run : one.plateau.runs) {
      const double change = force[run.end - 1] - force[run.first + (run.end - run.first) / 4];
      ++all;
      turned += -sign * change > enough ? 1 : 0;
    }
  }
  return 2 * turned > all;
}

// Those behind the noise, which one recording tells by itself: exactly one value each.
std::vector<ClippedEnd> exact_ends_of_force(const std::vector<Recording>& recordings) {
  std::vector<ClippedEnd> ends;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    for (const FlatEnd& one : saturated_ends_of_force(recordings[k])) {
      auto at = std::ranges::find(ends, one.value, &ClippedEnd::level);
      if (at == ends.end()) at = ends.insert(at, {one.value, {}, 0.0});
      at->recordings.push_back(k);
      at->share = std::max(at->share, one.share);
    }
  }
  return ends;
}

std::vector<ClippedEnd> ends_of_force(const std::vector<Recording>& recordings) {
  if (std::ranges::any_of(recordings, [](const Recording& one) { return one.force.empty(); })) return {};
  std::vector<ClippedEnd> ends = exact_ends_of_force(recordings);
  if (!ends.empty()) return ends;
  std::vector<Resting> alone;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Resting> resting = resting_at_one_end(recordings, {&Recording::force, sign});
    if (resting.empty()) continue;
    // Friction rests in all recordings.
    const bool in_some = some_stay_short(recordings, resting, sign) &&
                         (2 * resting.size() <= recordings.size() || drives_differ(recordings, resting));
    if (!in_some && !rod_goes_on(recordings, resting)) continue;
    ends.push_back(end_of(resting, sign));
    alone = std::move(resting);
  }
  if (ends.size() == 1 && void_follows(recordings, alone)) return {};
  return ends;
}

std::vector<ClippedEnd> ends_of_displacement(const std::vector<Recording>& recordings) {
  std::vector<ClippedEnd> ends;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Resting> resting = resting_at_one_end(recordings, {&Recording::displacement, sign});
    if (!resting.empty() && force_turns(recordings, resting, sign)) ends.push_back(end_of(resting, sign));
  }
  return ends;
}

}  // namespace

std::vector<Clipping> clipping_of(const std::vector<Recording>& recordings) {
  const bool complete = std::ranges::all_of(recordings, [](const Recording& one) {
    return one.displacement.size() == one.size() && one.velocity.size() == one.size() && one.force.size() == one.size();
  });
  std::vector<Clipping> result;
  if (!complete) return result;
  if (auto ends = ends_of_force(recordings); !ends.empty()) result.push_back({&Recording::force, std::move(ends)});
  if (auto ends = ends_of_displacement(recordings); !ends.empty()) {
    result.push_back({&Recording::displacement, std::move(ends)});
  }
  return result;
}

std::string sentence_of(const Clipping& clipping, std::size_t recordings) {
  const bool force = clipping.channel == &Recording::force;
  std::set<std::size_t> at;
  double share = 0.0;
  std::string levels;
  for (const ClippedEnd& end : clipping.ends) {
    at.insert(end.recordings.begin(), end.recordings.end());
    share = std::max(share, end.share);
    levels += fmt::format("{}{:.3g}", levels.empty() ? "" : " and ", force ? end.level : 1e3 * end.level);
  }
  const std::string where = recordings == 1 ? "" : fmt::format(", in {} of {} recordings", at.size(), recordings);
  const std::string meanwhile = !force            ? ", while the force turns round"
                                : recordings == 1 ? ""
                                                  : ", whatever the motion and the drive";
  return fmt::format(
      "the {} rests at {} {}, {} of its range{}, for up to {:.0f} % of the samples{}: a channel that "
      "saturates looks so; record with a wider range{}",
      force ? "force" : "displacement", levels, force ? "N" : "mm", clipping.ends.size() > 1 ? "the ends" : "an end",
      where, 100.0 * share, meanwhile, recordings == 1 ? "" : ", or leave these recordings out");
}

}  // namespace hysteron
