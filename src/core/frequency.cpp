#include "core/frequency.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/robust.hpp"

namespace hysteron {
namespace {

// Of the span, that the displacement goes back by where it has turned.
constexpr double least_swing = 0.1;
// Half periods within this share of their median, or within so many samples, belong to one frequency: where there is
// one, sampling alone makes them differ by a sample.
constexpr double alike_share = 0.05;
constexpr double alike_samples = 1.01;
// Where turns come at other times too, the frequency is that of the sine that is nearly all of the displacement, if one
// is: a motion of several tones is as fast as it turns.
constexpr double nearly_all = 0.9;
// Samples that it is looked for in, of a turn and in all.
constexpr std::size_t samples_of_a_turn = 8;
constexpr std::size_t fewest_samples = 256;
constexpr std::size_t most_samples = 2048;

// When the displacement turns at or beside this sample: the vertex of a parabola through it and its neighbours.
double turn_at(const Recording& recording, std::size_t n) {
  const std::vector<double>& x = recording.displacement;
  if (n == 0 || n + 1 >= x.size()) {
    return recording.time[n];
  }
  const double bend = x[n - 1] - 2.0 * x[n] + x[n + 1];
  const double off = bend != 0.0 ? std::clamp(0.5 * (x[n - 1] - x[n + 1]) / bend, -0.5, 0.5) : 0.0;
  return recording.time[n] + off * 0.5 * (recording.time[n + 1] - recording.time[n - 1]);
}

struct Turn {
  std::size_t at;  // the sample at or beside it
  double time;     // s
};

// Where the displacement turns, but for its ends.
std::vector<Turn> turns_of(const Recording& recording) {
  const auto& x = recording.displacement;
  if (x.size() < 3) {
    return {};
  }
  const auto [low, high] = std::ranges::minmax(x);
  const double threshold = least_swing * (high - low);
  if (!(threshold > 0.0)) {
    return {};
  }
  std::vector<Turn> turns;
  double extreme = x[0];
  std::size_t at = 0;
  int direction = 0;
  for (std::size_t n = 1; n < x.size(); ++n) {
    const bool further = direction >= 0 ? x[n] > extreme : x[n] < extreme;
    if (direction == 0) {
      if (std::fabs(x[n] - x[0]) > threshold) {
        direction = x[n] > x[0] ? 1 : -1;
        extreme = x[n];
        at = n;
      }
    } else if (further) {
      extreme = x[n];
      at = n;
    } else if (std::fabs(x[n] - extreme) > threshold) {
      turns.push_back({at, turn_at(recording, at)});
      direction = -direction;
      extreme = x[n];
      at = n;
    }
  }
  return turns;
}

// The mean of those that are like their median, and how many there are.
struct Alike {
  double mean = 0.0;
  std::size_t count = 0;
};
Alike alike_of(const std::vector<double>& times, double step) {
  const double median = median_of(times);
  const double alike = std::max(alike_share * median, alike_samples * step);
  Alike result;
  for (const double time : times) {
    if (std::fabs(time - median) > alike) continue;
    result.mean += time;
    ++result.count;
  }
  result.mean /= static_cast<double>(result.count);
  return result;
}

// When the displacement is half way from one turn to the next.
double half_way(const Recording& recording, const Turn& from, const Turn& to) {
  const std::vector<double>& x = recording.displacement;
  const double middle = 0.5 * (x[from.at] + x[to.at]);
  const bool up = x[to.at] > x[from.at];
  std::size_t n = from.at + 1;
  while (n < to.at && (up ? x[n] < middle : x[n] > middle)) ++n;
  return std::lerp(recording.time[n - 1], recording.time[n],
                   std::clamp((middle - x[n - 1]) / (x[n] - x[n - 1]), 0.0, 1.0));
}

// Of whole periods where most of them are alike, 0 where they are not: strokes of unequal length, and rests between
// them, make half periods that are not. Taken half way, as a rest has no turn that could be placed.
double frequency_of_periods(const Recording& recording, const std::vector<Turn>& turns, double step) {
  std::vector<double> half_ways;
  for (std::size_t k = 1; k < turns.size(); ++k) half_ways.push_back(half_way(recording, turns[k - 1], turns[k]));
  std::vector<double> periods;
  for (std::size_t k = 2; k < half_ways.size(); ++k) periods.push_back(half_ways[k] - half_ways[k - 2]);
  if (periods.size() < 2) return 0.0;
  const Alike alike = alike_of(periods, step);
  return 2 * alike.count > periods.size() ? 1.0 / alike.mean : 0.0;
}

// The displacement at equal steps of time, each the mean of the samples about it, or between those beside it where
// there are none.
struct Even {
  double step = 0.0;  // s
  std::vector<double> x;
};
Even evenly(const Recording& recording, std::size_t count) {
  const std::vector<double>& time = recording.time;
  const double span = time.back() - time.front();
  Even result{span / static_cast<double>(count - 1), std::vector<double>(count)};
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = time.front() + static_cast<double>(k) * result.step;
    double sum = 0.0;
    double samples = 0.0;
    for (; n < time.size() && time[n] < at + 0.5 * result.step; ++n, ++samples) {
      sum += recording.displacement[n];
    }
    if (samples > 0.0) {
      result.x[k] = sum / samples;
      continue;
    }
    const std::size_t right = std::clamp<std::size_t>(n, 1, time.size() - 1);
    const double share = (at - time[right - 1]) / (time[right] - time[right - 1]);
    result.x[k] = std::lerp(recording.displacement[right - 1], recording.displacement[right], share);
  }
  return result;
}

// Share of the squares about a straight line, as of a drift, that a sine of this frequency beside one takes off, by
// least squares.
double share_of_sine(const Even& even, double frequency) {
  const double angle = 2.0 * std::numbers::pi * frequency * even.step;
  const double turn_cosine = std::cos(angle);
  const double turn_sine = std::sin(angle);
  double cosine = 1.0;
  double sine = 0.0;
  double c = 0.0, s = 0.0, cc = 0.0, cs = 0.0, ss = 0.0;
  double x = 0.0, xx = 0.0, xc = 0.0, xs = 0.0;
  double tt = 0.0, tc = 0.0, ts = 0.0, tx = 0.0;  // with the time, in steps from the middle
  double t = -0.5 * static_cast<double>(even.x.size() - 1);
  for (const double value : even.x) {
    tt += t * t;
    tc += t * cosine;
    ts += t * sine;
    tx += t * value;
    t += 1.0;
    c += cosine;
    s += sine;
    cc += cosine * cosine;
    cs += cosine * sine;
    ss += sine * sine;
    x += value;
    xx += value * value;
    xc += value * cosine;
    xs += value * sine;
    const double next = cosine * turn_cosine - sine * turn_sine;
    sine = sine * turn_cosine + cosine * turn_sine;
    cosine = next;
  }
  const auto count = static_cast<double>(even.x.size());
  cc -= c * c / count + tc * tc / tt;
  cs -= c * s / count + tc * ts / tt;
  ss -= s * s / count + ts * ts / tt;
  xx -= x * x / count + tx * tx / tt;
  xc -= x * c / count + tx * tc / tt;
  xs -= x * s / count + tx * ts / tt;
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 0.0) || !(xx > 0.0)) {
    return 0.0;
  }
  const double taken = (ss * xc * xc - 2.0 * cs * xc * xs + cc * xs * xs) / determinant;
  return taken / xx;
}

// The sine that takes off most of the motion, of those that turn no more often than the motion does; 0 where none is
// nearly all of it, as none is of a sweep or of noise.
double frequency_of_sine(const Recording& recording, std::size_t turns) {
  const std::size_t count =
      std::min({recording.size(), most_samples, std::max(fewest_samples, samples_of_a_turn * turns)});
  const Even even = evenly(recording, count);
  const double span = recording.time.back() - recording.time.front();
  const double apart = 0.5 / span;
  const double highest = std::min(static_cast<double>(turns + 1) * apart, 0.4 / even.step);
  double best = 0.0;
  double share = 0.0;
  for (std::size_t k = 2; static_cast<double>(k) * apart <= highest; ++k) {
    const double frequency = static_cast<double>(k) * apart;
    if (const double of_this = share_of_sine(even, frequency); of_this > share) {
      share = of_this;
      best = frequency;
    }
  }
  // By golden sections, to a ten-thousandth of a period over the whole recording.
  constexpr double golden = 0.6180339887498949;
  double low = best - apart;
  double high = best + apart;
  while (high - low > 1e-4 * apart) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    if (share_of_sine(even, left) < share_of_sine(even, right)) {
      low = left;
    } else {
      high = right;
    }
  }
  best = 0.5 * (low + high);
  return share_of_sine(even, best) >= nearly_all ? best : 0.0;
}

}  // namespace

bool turns_once(const Recording& recording) { return turns_of(recording).size() == 1; }

double dominant_frequency(const Recording& recording) {
  const std::vector<Turn> turns = turns_of(recording);
  if (turns.size() < 2) {
    return 0.0;
  }
  std::vector<double> halves;
  for (std::size_t k = 1; k < turns.size(); ++k) {
    halves.push_back(turns[k].time - turns[k - 1].time);
  }
  // In the mean of those like the median the errors of their ends cancel.
  const double step = (recording.time.back() - recording.time.front()) / static_cast<double>(recording.size() - 1);
  const Alike alike = alike_of(halves, step);
  const double by_turns = 0.5 / alike.mean;
  if (alike.count == halves.size()) {
    return by_turns;
  }
  const double of_sine = frequency_of_sine(recording, turns.size());
  // Where most half periods are alike the others are those of a ramp or a rest, which a sine knows nothing of.
  const bool ramp = 2 * alike.count > halves.size() && std::fabs(of_sine - by_turns) <= alike_share * by_turns;
  if (of_sine > 0.0 && !ramp) return of_sine;
  // Of two strokes of unequal length one is half of them, or one more.
  const bool one_of_two = 2 * alike.count <= halves.size() + 1;
  const double of_periods = one_of_two ? frequency_of_periods(recording, turns, step) : 0.0;
  return of_periods > 0.0 ? of_periods : by_turns;
}

}  // namespace hysteron
