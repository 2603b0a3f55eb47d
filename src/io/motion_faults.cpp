#include "io/motion_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "core/extent.hpp"
#include "core/mean.hpp"
#include "core/robust.hpp"
#include "core/squared.hpp"
#include "io/channel_faults.hpp"
#include "io/channel_lag.hpp"
#include "io/strokes.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A leap is so many times longer than each of this many steps on either side and than the noise of the channel, and
// this part of the span at least.
constexpr double longer = 8.0;
constexpr std::size_t steps_beside = 4;
constexpr double least_leap = 0.02;
// A step of the motion itself has rest on one side. The channel moves where it goes by this part of the leap, and
// beyond its noise, within this part of the time of a usual stroke, whatever the sampling rate.
constexpr double moving = 0.02;
constexpr double near = 0.125;

// A counter that overflows jumps by nearly its range, what is half of it is looked at; once in so many samples at most.
// Its speed on one side is at least this part of that on the other.
constexpr double wraps_by = 0.5;
constexpr double nearly = 0.9;
constexpr std::size_t fewest_samples_a_wrap = 10;
constexpr double same_speed = 0.5;
constexpr std::size_t fewest_at_reversals = 4;

// A channel that leaves its path stays away for so many samples at most; one of so many does.
constexpr std::size_t longest_excursion = 2;
constexpr std::size_t fewest_samples_each = 50;

// At an end the path is that of a polynomial through the next samples, of one of these degrees: a high one follows the
// motion, a low one has less noise. What it misses of so many samples is how well it tells. A corner between straight
// lines is missed by two steps.
constexpr std::array<std::size_t, 3> degrees = {1, 2, 3};
constexpr std::size_t samples_that_tell = 16;
constexpr std::size_t longest_end = 5;
constexpr double more_than_a_corner = 3.0;

// A dropout has so many samples at most, and there are so many.
constexpr std::size_t longest_dropout = 10;
constexpr std::size_t fewest_dropouts = 2;

// Of the stretches of one value, this share has the same length, give or take one sample, and there are so many.
constexpr double alike = 0.95;
constexpr std::size_t fewest_holds = 30;
constexpr double least_hold = 1.8;
// A converter's steps are of one or two sizes where those of a held signal are of many.
constexpr std::size_t fewest_sizes = 10;

double step_at(const std::vector<double>& values, std::size_t n) { return std::fabs(values[n + 1] - values[n]); }

// How a channel goes on from sample `from`, beside a leap: forwards or backwards.
struct Beside {
  std::size_t held = 0;  // samples more that have the value of `from`
  bool moves = false;    // behind these it goes further than `enough` within `reach` samples, by steps below `widest`
};
Beside beside(const std::vector<double>& values, std::size_t from, bool forwards, std::size_t reach, double enough,
              double widest) {
  const std::size_t left = forwards ? values.size() - 1 - from : from;
  const auto at = [&](std::size_t k) { return values[forwards ? from + k : from - k]; };
  Beside result;
  while (result.held < left && at(result.held + 1) == values[from]) ++result.held;
  for (std::size_t k = result.held + 1; k <= std::min(left, result.held + reach); ++k) {
    if (std::fabs(at(k) - at(k - 1)) >= widest) break;
    if (std::fabs(at(k) - values[from]) > enough) {
      result.moves = true;
      break;
    }
  }
  return result;
}

}  // namespace

std::optional<Leap> leap_of(const std::vector<double>& time, const std::vector<double>& values) {
  Leap leap;
  for (std::size_t n = 0; n + 1 < values.size(); ++n) {
    const double step = step_at(values, n);
    if (step > leap.size) leap = {n, step};
  }
  if (leap.after < steps_beside || leap.after + 1 + steps_beside >= values.size() ||
      leap.size < least_leap * span_of(values)) {
    return std::nullopt;
  }
  double widest = 0.0;
  for (std::size_t k = 1; k <= steps_beside; ++k) {
    widest = std::max({widest, step_at(values, leap.after - k), step_at(values, leap.after + k)});
  }
  const double usual = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const bool in_time = time[leap.after + 1] - time[leap.after] < 2.0 * usual;
  if (!in_time || leap.size <= longer * widest) return std::nullopt;
  const double noise = channel_noise(time, values);
  if (leap.size <= longer * noise) return std::nullopt;
  const std::size_t stroke = samples_a_stroke(values);
  const std::size_t reach = std::max(steps_beside, static_cast<std::size_t>(near * static_cast<double>(stroke)));
  const double enough = std::max(moving * leap.size, longer * noise);
  const Beside before = beside(values, leap.after, false, reach, enough, leap.size / longer);
  const Beside after = beside(values, leap.after + 1, true, reach, enough, leap.size / longer);
  // A channel that was stuck for less than a stroke leaps to where the motion went meanwhile.
  const bool stuck = std::min(before.held, after.held) < reach && std::max(before.held, after.held) < stroke;
  return before.moves && after.moves && stuck ? std::optional(leap) : std::nullopt;
}

std::optional<Wrap> wrap_of(const std::vector<double>& time, const std::vector<double>& values) {
  if (values.size() < 2 * steps_beside) return std::nullopt;
  const double span = span_of(values);
  const auto is_jump = [&](std::size_t n) { return step_at(values, n) > wraps_by * span; };
  std::vector<std::size_t> jumps;
  for (std::size_t n = 0; n + 1 < values.size(); ++n) {
    if (is_jump(n)) jumps.push_back(n);
  }
  if (jumps.empty() || jumps.size() * fewest_samples_a_wrap > values.size()) return std::nullopt;
  const double noise = channel_noise(time, values);
  const double usual = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const std::size_t reach =
      std::max(steps_beside, static_cast<std::size_t>(near * static_cast<double>(samples_a_stroke(values))));
  // From a sample on, in steps of one, as far as the channel moves on against the jump: its speed, 0 where it does not.
  double widest = 0.0;  // of these steps
  const auto speed_beside = [&](std::size_t from, bool forwards, double sign) {
    const std::size_t left = forwards ? values.size() - 1 - from : from;
    double speed = 0.0;
    for (std::size_t k = 1; k <= std::min(left, reach); ++k) {
      const std::size_t at = forwards ? from + k : from - k;
      const double step = forwards ? values[at] - values[at - 1] : values[at + 1] - values[at];
      if (is_jump(forwards ? at - 1 : at) || sign * step > 4.0 * noise) break;
      widest = std::max(widest, std::fabs(step));
      const double way = forwards ? values[at] - values[from] : values[from] - values[at];
      if (k < 2 || sign * way > -longer * noise) continue;
      speed = way / std::fabs(time[at] - time[from]);
      if (k >= steps_beside) break;
    }
    return speed;
  };
  std::optional<Wrap> first;
  std::size_t alike_ones = 0;
  std::size_t against = 0;  // the jump, on both sides
  for (const std::size_t n : jumps) {
    const double sign = std::copysign(1.0, values[n + 1] - values[n]);
    widest = 0.0;
    const double before = speed_beside(n, false, sign);
    const double after = speed_beside(n + 1, true, sign);
    // What is no jump from one end of the range to the other, or lies in a gap of the times, is another fault.
    const double size = step_at(values, n);
    const bool whole = size >= nearly * span || size + 2.0 * widest >= span;
    if (!whole || 4.0 * widest > size || time[n + 1] - time[n] >= 2.0 * usual) return std::nullopt;
    if (before == 0.0 || after == 0.0) continue;
    ++against;
    const double slow = std::min(std::fabs(before), std::fabs(after));
    const bool same = slow >= same_speed * std::max(std::fabs(before), std::fabs(after));
    if (!first || (same && alike_ones == 0)) {
      first = Wrap{n, size + 0.5 * (std::fabs(before) + std::fabs(after)) * usual, before, after, jumps.size()};
    }
    alike_ones += same ? 1 : 0;
  }
  // Beside a reversal the speeds differ; what goes against so many jumps, each time on both sides, turns there.
  const bool all = against == jumps.size() && against >= fewest_at_reversals;
  return 2 * against > jumps.size() && (alike_ones > 0 || all) ? first : std::nullopt;
}

std::optional<Excursion> excursion_of(const std::vector<double>& time, const std::vector<double>& values) {
  constexpr std::size_t around = steps_beside + longest_excursion;
  const double least = least_leap * span_of(values);
  Excursion result;
  double furthest = 0.0;
  for (std::size_t n = steps_beside; n + around + 1 < values.size(); ++n) {
    const double out = values[n + 1] - values[n];
    if (std::fabs(out) <= least) continue;
    for (std::size_t count = 1; count <= longest_excursion; ++count) {
      const std::size_t last = n + count;
      const double back = values[last + 1] - values[last];
      const double size = std::min(std::fabs(out), std::fabs(back));
      double widest = 0.0;
      for (std::size_t k = 1; k <= steps_beside; ++k) {
        widest = std::max({widest, step_at(values, n - k), step_at(values, last + k)});
      }
      const bool returns = out * back < 0.0 && size > std::max(least, longer * widest) &&
                           std::fabs(values[last + 1] - values[n]) <= static_cast<double>(2 * (count + 1)) * widest;
      if (!returns || (count == 2 && 2.0 * step_at(values, n + 1) > size)) continue;
      ++result.count;
      if (size > furthest) {
        furthest = size;
        result.at = n + 1;
        result.from = values[n];
      }
      break;
    }
  }
  const bool few = result.count * fewest_samples_each <= values.size();
  return result.count > 0 && few && furthest > longer * channel_noise(time, values) ? std::optional(result)
                                                                                    : std::nullopt;
}

std::optional<StrayEnd> stray_end_of(const std::vector<double>& time, const std::vector<double>& values) {
  const std::size_t size = values.size();
  if (size < 2 * (longest_end + samples_that_tell)) return std::nullopt;
  const double usual = (time.back() - time.front()) / static_cast<double>(size - 1);
  const double span = span_of(values);
  std::optional<double> noise;  // when it is asked for
  const auto reach = [&] {
    return std::max(steps_beside, static_cast<std::size_t>(near * static_cast<double>(samples_a_stroke(values))));
  };
  for (const bool first : {true, false}) {
    const auto index = [&](std::size_t k) { return first ? k : size - 1 - k; };  // counted from the end looked at
    const auto value = [&](std::size_t k) { return values[index(k)]; };
    const auto step = [&](std::size_t k) { return std::fabs(value(k + 1) - value(k)); };
    // Of a sample, by those further in.
    const auto path = [&](std::size_t k, std::size_t degree) {
      double told = 0.0;
      double binomial = 1.0;
      for (std::size_t j = 1; j <= degree + 1; ++j) {
        binomial *= static_cast<double>(degree + 2 - j) / static_cast<double>(j);
        told += (j % 2 == 1 ? 1.0 : -1.0) * binomial * value(k + j);
      }
      return told;
    };
    for (std::size_t k = 0; k < longest_end; ++k) {
      double widest = 0.0;
      double longest = 0.0;  // s
      for (std::size_t j = k + 1; j <= k + samples_that_tell; ++j) widest = std::max(widest, step(j));
      for (std::size_t j = 0; j <= k + samples_that_tell; ++j) {
        longest = std::max(longest, std::fabs(time[index(j + 1)] - time[index(j)]));
      }
      if (longest > 2.0 * usual) continue;
      for (const std::size_t degree : degrees) {
        double missed = 0.0;
        for (std::size_t j = k + 1; j + degree + 1 <= k + 1 + samples_that_tell; ++j) {
          missed = std::max(missed, std::fabs(value(j) - path(j, degree)));
        }
        const double size_of_it = std::fabs(value(k) - path(k, degree));
        if (size_of_it <= std::max({longer * missed, more_than_a_corner * widest, least_leap * span})) continue;
        if (!noise) noise = channel_noise(time, values);
        const double enough = std::max(moving * size_of_it, longer * *noise);
        if (size_of_it <= longer * *noise ||
            !beside(values, index(k + 1), first, reach(), enough, size_of_it / more_than_a_corner).moves) {
          continue;
        }
        return StrayEnd{index(k), path(k, degree), k + 1, first};
      }
    }
  }
  return std::nullopt;
}

std::optional<Dropouts> dropouts_of(const std::vector<double>& values) {
  struct Candidate {
    std::size_t first;
    std::size_t count;
    double before;
    double after;
  };
  std::vector<Candidate> candidates;
  double widest = 0.0;  // of the other steps
  for_each_run(values, [&](std::size_t first, std::size_t count) {
    if (first == 0) return;
    const double before = values[first - 1];
    if (values[first] != 0.0) {
      if (before != 0.0) widest = std::max(widest, std::fabs(values[first] - before));
    } else if (first + count < values.size()) {
      const double after = values[first + count];
      if (count > longest_dropout) widest = std::max({widest, std::fabs(before), std::fabs(after)});
      if (count <= longest_dropout) candidates.push_back({first, count, before, after});
    }
  });
  if (!(widest > 0.0)) return std::nullopt;
  // A friction that turns and a channel that crosses zero are zero as well.
  std::erase_if(candidates, [&](const Candidate& one) {
    const bool far = std::min(std::fabs(one.before), std::fabs(one.after)) > longer * widest;
    return !far || std::fabs(one.after - one.before) > static_cast<double>(one.count + 1) * widest;
  });
  if (candidates.size() < fewest_dropouts) return std::nullopt;
  return Dropouts{candidates.size(), candidates.front().first};
}

std::optional<double> held_samples_of(const std::vector<double>& values) {
  std::vector<double> lengths;
  std::set<double> sizes;
  for_each_run(values, [&](std::size_t first, std::size_t count) {
    // What began before the recording, or goes on behind it, is not known.
    if (first == 0 || first + count == values.size()) return;
    lengths.push_back(static_cast<double>(count));
    if (sizes.size() < fewest_sizes) sizes.insert(std::fabs(values[first] - values[first - 1]));
  });
  if (lengths.size() < fewest_holds || sizes.size() < fewest_sizes) return std::nullopt;
  const double usual = median_of(lengths);
  const auto count_of = [&](double length) { return static_cast<double>(std::ranges::count(lengths, length)); };
  const double shorter = count_of(usual - 1.0);
  const double longer_ones = count_of(usual + 1.0);
  const double of_usual = count_of(usual);
  const double same = of_usual + std::max(shorter, longer_ones);
  // Of these alone: a few long stretches, as where a force is cut off or a rod rests, are no holds.
  const double mean = usual + (longer_ones >= shorter ? longer_ones : -shorter) / same;
  return same >= alike * static_cast<double>(lengths.size()) && mean >= least_hold ? std::optional(mean) : std::nullopt;
}

namespace {

// By how much the recorded velocity misses the displacement on average, between two samples.
double velocity_beyond_slope(const Recording& recording, std::size_t first, std::size_t last) {
  const std::vector<double>& time = recording.time;
  const std::vector<double>& v = recording.velocity;
  double way = 0.0;
  for (std::size_t n = first + 1; n <= last; ++n) way += 0.5 * (v[n] + v[n - 1]) * (time[n] - time[n - 1]);
  return (way - (recording.displacement[last] - recording.displacement[first])) / (time[last] - time[first]);
}

// Of its mean over so many parts: noise, a lag and a gain differ from part to part, an offset does not.
double error_of_offset(const Recording& recording) {
  constexpr std::size_t parts = 8;
  std::vector<double> offsets;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t last = recording.size() - 1;
    offsets.push_back(velocity_beyond_slope(recording, k * last / parts, (k + 1) * last / parts));
  }
  const double mean = mean_of(offsets);
  double squares = 0.0;
  for (const double offset : offsets) squares += squared(offset - mean);
  return std::sqrt(squares / static_cast<double>(parts * (parts - 1)));
}

}  // namespace

VelocityFault velocity_fault_of(const Recording& recording) {
  VelocityFault result;
  const std::optional<ChannelLag> lag = velocity_channel_lag(std::span(&recording, 1));
  if (!lag) return result;
  const std::vector<double>& v = recording.velocity;
  result.offset = velocity_beyond_slope(recording, 0, recording.size() - 1);
  result.offset_error = error_of_offset(recording);
  double largest = 0.0;
  double speeds = 0.0;
  double accelerations = 0.0;
  for (std::size_t n = 0; n < v.size(); ++n) {
    const double speed = v[n] - result.offset;
    largest = std::max(largest, std::fabs(speed));
    speeds += squared(speed);
    accelerations += squared(recording.derived_acceleration[n]);
  }
  if (!(largest > 0.0)) return result;
  result.offset_share = std::fabs(result.offset) / largest;
  result.lag = lag->lag;
  result.phase = std::atan(std::fabs(lag->lag) * std::sqrt(accelerations / speeds));
  return result;
}

double noise_share_of_velocity(const Recording& recording) {
  double squares = 0.0;
  std::size_t in_motion = 0;
  for (const double v : recording.velocity) {
    squares += squared(v);
    in_motion += v != 0.0 ? 1 : 0;
  }
  if (!(squares > 0.0)) return 0.0;
  const double noise = recording.velocity_measured ? channel_noise(recording.time, recording.velocity)
                                                   : derived_velocity_noise(recording.time, recording.displacement);
  return std::min(squared(noise) * static_cast<double>(in_motion) / squares, 1.0);
}

}  // namespace hysteron
