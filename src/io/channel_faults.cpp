#include "io/channel_faults.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// Samples whose different values are counted.
constexpr std::size_t most_looked_at = 65536;

// An end of a range: at least this share of the samples is at it, in two runs or more of so many, and so many times
// more than within a fiftieth of the span before it. Of a sine in steps, of whatever size, its crest is held by less
// than two and a half times as many samples as the step before; the part before is two and a half steps at least.
constexpr double least_share = 0.01;
constexpr std::size_t least_run = 4;
constexpr std::size_t least_runs = 2;
constexpr double near_the_end = 0.02;
constexpr double steps_before = 2.5;
constexpr double crowded = 4.0;
// Fewer values than these are steps of a converter, and a friction stays within one of them.
constexpr std::size_t least_values = 150;

// A stretch of zeros counts from this share of the samples on, and from so many: a play without noise has shorter ones.
constexpr double least_silent = 0.1;
constexpr std::size_t fewest_silent = 100;

std::vector<double> thinned(const std::vector<double>& values) {
  const std::size_t stride = values.size() / most_looked_at + 1;
  std::vector<double> some;
  for (std::size_t n = 0; n < values.size(); n += stride) some.push_back(values[n]);
  return some;
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

}  // namespace

std::optional<FlatEnd> flat_end_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  std::vector<double> some = thinned(values);
  std::ranges::sort(some);
  if (static_cast<std::size_t>(std::ranges::unique(some).begin() - some.begin()) < least_values) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(values);
  if (!(high > low)) return std::nullopt;
  const std::optional<FlatEnd> above = flat_end(values, high - low, 1.0);
  const std::optional<FlatEnd> below = flat_end(values, high - low, -1.0);
  return above && (!below || above->share >= below->share) ? above : below;
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

}  // namespace hysteron
