#include "io/channel_faults.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/extent.hpp"
#include "core/squared.hpp"
#include "io/saturation.hpp"

namespace hysteron {
namespace {

// Samples whose different values are counted.
constexpr std::size_t most_looked_at = 65536;

// Two samples side by side that stand out are outliers. A stop that the rod runs into is climbed in steps.
constexpr std::size_t least_placeholders = 3;
constexpr double far_step = 8.0;

// An end of a range: at least this share of the samples is at it, in two runs or more of so many, and so many times
// more than within a fiftieth of the span before it. Of a sine in steps, of whatever size, its crest is held by less
// than two and a half times as many samples as the step before; the part before is two and a half steps at least.
constexpr double least_share = 0.01;
constexpr std::size_t least_run = 4;
constexpr std::size_t least_runs = 2;
constexpr double near_the_end = 0.02;
constexpr double steps_before = 2.5;
constexpr double crowded = 4.0;
// Fewer values than these may be steps of a converter, and a friction stays within one of them ...
constexpr std::size_t least_values = 150;
// ... unless there is noise between the ends of more than a step, which would not let it: so many fifth differences
// are no smaller than the fourth ones tell, as those of a signal are, and there are so many values. A friction that
// approaches its yield force has many more samples near the ends than in between, a signal that is cut off has not.
constexpr std::size_t fewest_noisy_values = 30;
constexpr std::size_t fewest_differences = 16;
constexpr double white = 0.85;
constexpr double noise_in_steps = 0.7;  // rounding alone is 0.3 of a step, up to 0.4 where few samples tell it
constexpr double edge = 0.05;           // of the span, at either end
constexpr double denser = 3.0;

// A stretch of zeros counts from this share of the samples on, and from so many: a play without noise has shorter ones.
constexpr double least_silent = 0.1;
constexpr std::size_t fewest_silent = 100;

// At an end, so many do while the rod goes by this part of its span, where no other is longer than this part of them.
// The jump there is so many times longer than each of this many steps beside it, and this part of the force's span.
constexpr std::size_t fewest_at_an_end = 10;
constexpr double goes_at_an_end = 0.05;
constexpr double held_elsewhere = 0.25;
constexpr double jump = 3.0;
constexpr std::size_t steps_beside_jump = 8;
constexpr double least_jump = 0.1;

// A channel is frozen while the other one rises and falls by this part of its span ...
constexpr double goes_on = 0.25;
// ... and holds any other value for this part of the time at most: one of few values holds many of them so.
constexpr double held_else = 0.25;

// A force that relaxes to nothing while the motion rests loses less than half of itself in the last three quarters of
// that time, whatever its time constant: less than a quarter of its span. One that turns round in its middle loses
// more.
constexpr double turns = 0.25;

// Of a setting, below zero and above.
constexpr double least_nines_below = 99.0;
constexpr double least_nines_above = 9999.0;

// Whether it is written in nines, 9999 or 999.99; the conversion of its unit to and fro may have rounded it.
bool is_of_nines(double size) {
  constexpr double rounded = 1e-9;
  for (const double scale : {1.0, 10.0, 100.0}) {
    const double digits = std::round(scale * size);
    const double power = std::log10(digits + 1.0);
    if (std::fabs(scale * size - digits) <= rounded * digits && std::fabs(power - std::round(power)) < 1e-12)
      return true;
  }
  return false;
}

std::vector<double> thinned(const std::vector<double>& values) {
  const std::size_t stride = values.size() / most_looked_at + 1;
  std::vector<double> some;
  for (std::size_t n = 0; n < values.size(); n += stride) some.push_back(values[n]);
  return some;
}

// Mean squares of differences between neighbours, of an order, over those of white noise of variance 1.
class Differences {
 public:
  Differences(std::size_t order, double of_noise) : order_(order), of_noise_(of_noise) {}
  void add(std::vector<double> run) {
    for (std::size_t k = 0; k < order_ && !run.empty(); ++k) {
      for (std::size_t n = 0; n + 1 < run.size(); ++n) run[n] = run[n + 1] - run[n];
      run.pop_back();
    }
    for (const double difference : run) sum_ += squared(difference);
    count_ += run.size();
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double noise() const { return std::sqrt(sum_ / (of_noise_ * static_cast<double>(count_))); }

 private:
  std::size_t order_;
  double of_noise_;  // the sum of squares of the binomial coefficients
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

// Whether the channel is noisy between its ends, by more than the smallest step between two of its values (sorted).
bool is_noisy_inside(const std::vector<double>& values, const std::vector<double>& sorted) {
  const double low = sorted.front();
  const double high = sorted.back();
  Differences fourth(4, 70.0);
  Differences fifth(5, 252.0);
  std::size_t near_ends = 0;
  std::size_t between = 0;
  std::vector<double> run;
  const auto close_run = [&] {
    if (run.size() > 5) {
      fourth.add(run);
      fifth.add(run);
    }
    run.clear();
  };
  for (const double value : values) {
    if (value == low || value == high) {
      close_run();
      continue;
    }
    run.push_back(value);
    (std::min(value - low, high - value) < edge * (high - low) ? near_ends : between) += 1;
  }
  close_run();
  double step = high - low;
  for (std::size_t k = 1; k < sorted.size(); ++k) step = std::min(step, sorted[k] - sorted[k - 1]);
  return sorted.size() >= fewest_noisy_values && fifth.count() >= fewest_differences &&
         fifth.noise() >= white * fourth.noise() && fifth.noise() >= noise_in_steps * step &&
         (1.0 - 2.0 * edge) * static_cast<double>(near_ends) <= denser * 2.0 * edge * static_cast<double>(between);
}

// `sign` 1: the largest value, -1: the smallest.
std::optional<FlatEnd> flat_end(const std::vector<double>& values, double span, double sign) {
  double end = sign * values.front();
  for (const double value : values) end = std::max(end, sign * value);
  double next = end - span;  // the largest below the end
  for (const double value : values) next = sign * value < end ? std::max(next, sign * value) : next;
  const double before = end - std::max(near_the_end * span, steps_before * (end - next));
  std::size_t at = 0;
  std::size_t close = 0;
  std::size_t run = 0;
  std::size_t runs = 0;
  for (const double value : values) {
    const bool there = sign * value == end;
    at += there ? 1 : 0;
    close += !there && sign * value > before ? 1 : 0;
    run = there ? run + 1 : 0;
    runs += run == least_run ? 1 : 0;
  }
  const double share = static_cast<double>(at) / static_cast<double>(values.size());
  if (share < least_share || runs < least_runs || static_cast<double>(at) < crowded * static_cast<double>(close)) {
    return std::nullopt;
  }
  return FlatEnd{sign * end, share};
}

// Both ends, by how few samples come near them.
std::vector<FlatEnd> ends_left_alone(const std::vector<double>& values) {
  std::vector<double> some = thinned(values);
  std::ranges::sort(some);
  some.erase(std::unique(some.begin(), some.end()), some.end());
  const double span = span_of(values);
  if (!(span > 0.0) || (some.size() < least_values && !is_noisy_inside(values, some))) return {};
  std::vector<FlatEnd> ends;
  for (const double sign : {1.0, -1.0}) {
    if (const auto end = flat_end(values, span, sign)) ends.push_back(*end);
  }
  return ends;
}

}  // namespace

std::optional<FlatEnd> flat_end_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  std::vector<FlatEnd> ends = ends_left_alone(values);
  if (ends.empty()) {
    for (const double sign : {1.0, -1.0}) {
      if (const auto end = saturated_end_of(values, sign)) ends.push_back(*end);
    }
  }
  const auto longest = std::ranges::max_element(ends, {}, &FlatEnd::share);
  return longest == ends.end() ? std::nullopt : std::optional(*longest);
}

std::optional<Stretch> frozen_stretch_of(const std::vector<double>& values, const std::vector<double>& other) {
  if (values.empty() || values.size() != other.size()) return std::nullopt;
  const double enough = goes_on * span_of(other);
  if (!(enough > 0.0)) return std::nullopt;
  Stretch frozen;
  std::size_t longest = 0;  // of the others
  for_each_run(values, [&](std::size_t first, std::size_t count) {
    if (turned_by(std::span(other).subspan(first, count)) < enough) {
      longest = std::max(longest, count);
    } else if (count > frozen.count) {
      frozen = {first, count};
    }
  });
  const bool alone = frozen.count == values.size();
  const bool finer = longest > 0 && static_cast<double>(longest) <= held_else * static_cast<double>(frozen.count);
  return frozen.count > 0 && (alone || finer) ? std::optional(frozen) : std::nullopt;
}

bool force_turns_at(double end, const std::vector<double>& displacement, const std::vector<double>& force) {
  if (displacement.size() != force.size() || force.empty()) return false;
  const double enough = turns * span_of(force);
  const bool upper = std::ranges::max(displacement) == end;
  std::size_t turned = 0;
  std::size_t rested = 0;
  for_each_run(displacement, [&](std::size_t first, std::size_t count) {
    if (displacement[first] != end || count < least_run) return;
    const double change = force[first + count - 1] - force[first + count / 4];
    ((upper ? -change : change) > enough ? turned : rested) += 1;
  });
  return turned > rested;
}

std::optional<Placeholder> placeholder_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto [smallest, largest] = std::ranges::minmax(values);
  for (const double end : {smallest, largest}) {
    Placeholder result{end, 0, 0, largest, smallest};
    std::size_t longest = 0;
    double widest = 0.0;  // step of the others
    for_each_run(values, [&](std::size_t first, std::size_t count) {
      if (values[first] == end) {
        if (result.count == 0) result.first = first;
        result.count += count;
        longest = std::max(longest, count);
        return;
      }
      result.low = std::min(result.low, values[first]);
      result.high = std::max(result.high, values[first]);
      if (first > 0 && values[first - 1] != end) {
        widest = std::max(widest, std::fabs(values[first] - values[first - 1]));
      }
    });
    // A friction, or a drive that is switched, has two values.
    if (!(widest > 0.0)) continue;
    const double beyond = std::max(result.low - end, end - result.high);
    if (longest >= least_placeholders && beyond > std::max(result.high - result.low, far_step * widest)) return result;
  }
  return std::nullopt;
}

std::optional<Placeholder> placeholder_of_setting(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto [smallest, largest] = std::ranges::minmax(values);
  for (const double end : {smallest, largest}) {
    if ((end < 0.0 ? -end < least_nines_below : end < least_nines_above) || !is_of_nines(std::fabs(end))) continue;
    Placeholder result{end, 0, 0, largest, smallest};
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (values[n] == end) {
        if (result.count == 0) result.first = n;
        ++result.count;
      } else {
        result.low = std::min(result.low, values[n]);
        result.high = std::max(result.high, values[n]);
      }
    }
    const double beyond = std::max(result.low - end, end - result.high);
    const double far = std::max({result.high - result.low, std::fabs(result.low), std::fabs(result.high)});
    if (2 * result.count <= values.size() && beyond > far) return result;
  }
  return std::nullopt;
}

std::optional<Silence> silence_of(const std::vector<double>& values) {
  Silence longest;
  std::size_t run = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    run = values[n] == 0.0 ? run + 1 : 0;
    if (run > longest.count) longest = {n + 1 - run, run};
  }
  const bool long_enough = longest.count >= fewest_silent &&
                           static_cast<double>(longest.count) >= least_silent * static_cast<double>(values.size());
  return long_enough && longest.count < values.size() ? std::optional(longest) : std::nullopt;
}

std::optional<Silence> silence_at_an_end_of(const std::vector<double>& force, const std::vector<double>& displacement) {
  if (force.size() != displacement.size() || silence_of(force)) return std::nullopt;
  std::vector<Silence> silent;
  for_each_run(force, [&](std::size_t first, std::size_t count) {
    if (force[first] == 0.0) silent.push_back({first, count});
  });
  for (const Silence& one : silent) {
    const std::size_t end = one.first + one.count;
    const bool at_start = one.first == 0;
    if (one.count < fewest_at_an_end || at_start == (end == force.size())) continue;
    if (std::ranges::any_of(silent, [&](const Silence& other) {
          return other.first != one.first &&
                 static_cast<double>(other.count) > held_elsewhere * static_cast<double>(one.count);
        })) {
      continue;
    }
    const double way = span_of(std::span(displacement).subspan(one.first, one.count));
    if (way < goes_at_an_end * span_of(displacement)) continue;
    const std::size_t left = at_start ? force.size() - end : one.first;
    const auto beside = [&](std::size_t k) { return force[at_start ? end + k : one.first - 1 - k]; };
    double widest = 0.0;
    for (std::size_t k = 0; k + 1 < left && k < steps_beside_jump; ++k) {
      widest = std::max(widest, std::fabs(beside(k + 1) - beside(k)));
    }
    if (std::fabs(beside(0)) > std::max(jump * widest, least_jump * span_of(force))) return one;
  }
  return std::nullopt;
}

}  // namespace hysteron
