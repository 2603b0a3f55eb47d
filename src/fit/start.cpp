#include "fit/start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "core/mean.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

// A force that settles differs from that one period later, within this part of the first period, by this factor more
// than in the rest of it, or than the second period differs from the third, and by this share of the peak force.
constexpr std::size_t settling_part = 8;
constexpr double settling_factor = 3.0;
constexpr double settling_share = 0.05;
constexpr std::size_t neighbours = 2;

// Where the first sample alone tells, it is between the two forces that the loop has at its displacement, nearer to the
// one it goes on with: out of nothing what follows the velocity is there and what lags behind is not. The other one is
// looked for within this part of the stroke. Exactly zero is a channel that was not ready.
constexpr double nearest_back = 0.1;
bool first_is_within_the_loop(const Recording& recording, std::size_t period, double slack) {
  std::size_t back = 0;
  double least = nearest_back * span_of(recording.displacement);
  for (std::size_t n = 1; n < period; ++n) {
    const double away = std::fabs(recording.displacement[n] - recording.displacement[0]);
    if (recording.velocity[n] * recording.velocity[0] >= 0.0 || away >= least) continue;
    least = away;
    back = n;
  }
  const double first = recording.force[0];
  if (back == 0 || first == 0.0) return false;
  const double there = recording.force[period];
  const double middle = 0.5 * (there + recording.force[back]);
  return first > std::min(there, middle) - slack && first < std::max(there, middle) + slack;
}

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
  // The nearest of the neighbours one period later: the period is no whole number of samples, and friction jumps.
  const auto change = [&](std::size_t n) {
    double least = 1e300;
    const std::size_t from = n + period - std::min(neighbours, n + period);
    for (std::size_t m = from; m <= std::min(n + period + neighbours, recording.size() - 1); ++m) {
      least = std::min(least, std::fabs(recording.force[m] - recording.force[n]));
    }
    return least;
  };
  // The second largest: one outlier tells nothing, unless it is the first sample and where it would be.
  std::array<double, 2> early = {0.0, 0.0};
  double late = 0.0;
  for (std::size_t n = 0; n < period; ++n) {
    if (n >= period / settling_part) {
      late = std::max(late, change(n));
    } else if (change(n) > early[0]) {
      early = {change(n), early[0]};
    } else {
      early[1] = std::max(early[1], change(n));
    }
  }
  if (recording.size() >= 3 * period) {
    double next = 0.0;
    for (std::size_t n = period; n < 2 * period; ++n) {
      next = std::max(next, change(n));
    }
    late = std::min(late, next);
  }
  const auto is_more = [&](double size) { return size > settling_factor * late && size > settling_share * peak; };
  return is_more(early[1]) || (is_more(change(0)) && first_is_within_the_loop(recording, period, late));
}

// Share of its standard deviation by which a motion of this period may miss itself one period later, and the part of a
// period that must be there to tell.
constexpr double repeating_share = 0.3;
constexpr double telling_part = 0.25;

// Whether the first period of the motion comes again, so far as the recording lasts: a broadband motion may come back
// to its first sample and go on elsewhere.
bool repeats(const Recording& recording, std::size_t period) {
  const std::size_t count = std::min(period, recording.size() - period);
  if (static_cast<double>(count) < telling_part * static_cast<double>(period)) {
    return true;
  }
  double mean = 0.0;
  for (std::size_t n = 0; n < period; ++n) {
    mean += recording.displacement[n] / static_cast<double>(period);
  }
  double squares = 0.0;
  double variance = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const double change = recording.displacement[n + period] - recording.displacement[n];
    squares += change * change;
  }
  for (std::size_t n = 0; n < period; ++n) {
    const double away = recording.displacement[n] - mean;
    variance += away * away / static_cast<double>(period);
  }
  return std::sqrt(squares / static_cast<double>(count)) < repeating_share * std::sqrt(variance);
}

// A motion of several tones comes again where it misses itself by this share of its standard deviation, and by what
// half a sample more or less does: its period is no whole number of them.
constexpr double tones_share = 0.03;
// Samples in which its period is looked for first, and how much more it may miss itself there.
constexpr std::size_t first_look = 1000;
constexpr double first_look_times = 8.0;

// Root mean square change of the displacement over so many samples, of every `stride`-th one.
double change_after(const std::vector<double>& x, std::size_t lag, std::size_t stride) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t n = 0; n + lag < x.size(); n += stride, ++count) {
    const double change = x[n + lag] - x[n];
    squares += change * change;
  }
  return std::sqrt(squares / count);
}

// Samples after which a motion with harmonics, or of several tones, comes again, twice at least; 0 where it does not.
// Its turns tell nothing of that.
std::size_t tones_return_after(const std::vector<double>& x) {
  const std::size_t stride = std::max<std::size_t>(1, x.size() / first_look);
  const double mean = mean_of(x);
  double variance = 0.0;
  for (const double value : x) variance += squared(value - mean) / static_cast<double>(x.size());
  const double deviation = std::sqrt(variance);
  const double tolerance = tones_share * deviation + 0.5 * change_after(x, 1, 1);
  bool left = false;  // the motion is no longer where it was at first
  for (std::size_t lag = stride; 2 * lag <= x.size(); lag += stride) {
    const double change = change_after(x, lag, stride);
    left = left || change > deviation;
    if (!left || change > first_look_times * tolerance) {
      continue;
    }
    std::size_t best = lag;
    double least = change_after(x, lag, 1);
    for (std::size_t near = lag - stride + 1; near < lag + stride && 2 * near <= x.size(); ++near) {
      if (const double of_this = change_after(x, near, 1); of_this < least) {
        least = of_this;
        best = near;
      }
    }
    if (least <= tolerance) {
      return best;
    }
  }
  return 0;
}

// At a turning point of a running motion the velocity is small too: at rest it stays small.
bool begins_at_rest(const Recording& recording, double frequency) {
  const double peak = peak_of(recording.velocity);
  if (std::fabs(recording.velocity[0]) >= 0.05 * peak) {
    return false;
  }
  const double quarter = recording.time[0] + 0.125 / frequency;
  for (std::size_t n = 0; n < recording.size() && recording.time[n] < quarter; ++n) {
    if (std::fabs(recording.velocity[n]) > 0.3 * peak) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::size_t returns_after(const Recording& recording, double frequency) {
  if (!(frequency > 0.0) || begins_at_rest(recording, frequency)) {
    return 0;
  }
  const double peak = peak_of(recording.velocity);
  const auto [low, high] = std::ranges::minmax(recording.displacement);
  const double stroke = high - low;
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
  return best > 0 && repeats(recording, best) ? best : 0;
}

std::size_t period_of(const Recording& recording, double frequency) {
  const std::size_t by_turns = returns_after(recording, frequency);
  return by_turns > 0 || !(frequency > 0.0) || begins_at_rest(recording, frequency)
             ? by_turns
             : tones_return_after(recording.displacement);
}

Start start_of(const Recording& recording) {
  if (recording.start != Start::unknown) {
    return recording.start;
  }
  const std::size_t period = period_of(recording, dominant_frequency(recording));
  return period > 0 && force_settles(recording, period) ? Start::from_nothing : Start::in_cycle;
}

}  // namespace hysteron
