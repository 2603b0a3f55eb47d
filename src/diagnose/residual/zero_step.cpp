#include "diagnose/residual/zero_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/mean.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

// Of the recording, that a step has on either side.
constexpr double least_side = 0.05;
// Of the squared residual, that the step explains: it is most of what is left.
constexpr double least_share = 0.5;
// Cosines of the slow course that a step must do better than: a random walk has nine tenths of its squares in them.
constexpr int slow_terms = 6;
// The motion is the same on both sides where its middle and its spread, and the middle of its drive, differ by no more
// than this share of the largest.
constexpr double same = 0.25;

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};
Spread spread_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += squared(value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

// Whether a channel does on both sides of sample `at` what it does on the other.
bool alike(const std::vector<double>& values, std::size_t from, std::size_t at, bool also_spread) {
  const std::span<const double> all(values);
  const Spread before = spread_of(all.subspan(from, at - from));
  const Spread after = spread_of(all.subspan(at));
  const auto [low, high] = std::ranges::minmax(all.subspan(from));
  const double largest = std::max(std::fabs(low), std::fabs(high));
  const auto [less, more] = std::minmax(before.deviation, after.deviation);
  return std::fabs(before.mean - after.mean) <= same * largest && (!also_spread || more - less <= same * more);
}

double slow_squares(std::span<const double> residual, double mean) {
  const auto count = static_cast<double>(residual.size());
  double result = 0.0;
  for (int term = 1; term <= slow_terms; ++term) {
    double sum = 0.0;
    for (std::size_t n = 0; n < residual.size(); ++n) {
      sum += (residual[n] - mean) * std::cos(std::numbers::pi * term * (static_cast<double>(n) + 0.5) / count);
    }
    result += 2.0 / count * sum * sum;
  }
  return result;
}

}  // namespace

std::optional<ZeroStep> zero_step_of(const Recording& recording, const Residual& residual) {
  const std::span<const double> left = std::span(residual.force).subspan(residual.from);
  if (left.empty()) return std::nullopt;
  const auto count = static_cast<double>(left.size());
  const Spread all = spread_of(left);
  const double squares = all.deviation * all.deviation * count;
  const auto side = static_cast<std::size_t>(std::ceil(least_side * count));
  double sum = 0.0;  // about the mean, of the samples before n
  double best = 0.0;
  std::size_t at = 0;
  double sum_at = 0.0;
  for (std::size_t n = 0; n < left.size(); ++n) {
    const auto before = static_cast<double>(n);
    const double gain = n > 0 ? sum * sum * count / (before * (count - before)) : 0.0;
    if (n >= side && n + side <= left.size() && gain > best) {
      best = gain;
      at = n;
      sum_at = sum;
    }
    sum += left[n] - all.mean;
  }
  // Written so that NaN is none.
  if (!(best >= least_share * squares) || !(squares > 0.0) || !(best > slow_squares(left, all.mean))) {
    return std::nullopt;
  }
  const std::size_t sample = residual.from + at;
  if (!alike(recording.displacement, residual.from, sample, true) ||
      !alike(recording.velocity, residual.from, sample, true) ||
      (!recording.drive.empty() && !alike(recording.drive, residual.from, sample, false))) {
    return std::nullopt;
  }
  const auto before = static_cast<double>(at);
  // The residual is simulated less measured.
  return ZeroStep{recording.time[sample] - recording.time.front(), sum_at / before + sum_at / (count - before),
                  best / squares};
}

std::optional<ZeroSteps> zero_steps_of(const std::vector<Recording>& recordings,
                                       const std::vector<Residual>& residuals) {
  ZeroSteps result;
  result.of = recordings.size();
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const std::optional<ZeroStep> found = zero_step_of(recordings[k], residuals[k]);
    if (!found) continue;
    if (++result.with == 1 || std::fabs(found->step) > std::fabs(result.largest.step)) {
      result.largest = *found;
      result.file = recordings[k].file;
    }
  }
  return result.with > 0 ? std::optional(result) : std::nullopt;
}

std::string sentence_of(const ZeroSteps& steps) {
  return fmt::format(
      "the zero of the force steps by {:.3g} N at {:.3g} s of {} ({} of {} recordings {} such a step), as of a load "
      "cell that is zeroed while the test runs, and effects explain it as physics: cut the recordings there, or "
      "shift the force back",
      steps.largest.step, steps.largest.time, steps.file, steps.with, steps.of, steps.with == 1 ? "has" : "have");
}

bool shape_the_search(const ZeroSteps& steps) { return 2 * steps.with > steps.of; }

}  // namespace hysteron
