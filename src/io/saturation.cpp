#include "io/saturation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/extent.hpp"
#include "core/robust.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// So many samples of a hundred are at the end, and so many times more than at any other value between the ends: noise
// has fewer samples at its largest value than at the ones before, in whatever steps.
constexpr double least_share = 0.01;
constexpr std::size_t fewest_at_end = 10;
constexpr double more_often = 4.0;
// Noise is told by so many differences. Every order of them tells the same deviation of it, of a smooth channel the
// higher one tells less (io/held_ends.cpp).
constexpr std::size_t fewest_differences = 32;
// Of fewer samples from end to end most sixth differences reach over the middle, where a reversal is roughest.
constexpr std::size_t shortest_run = 12;
constexpr double white = 0.85;
// Noise is of one size everywhere: half of its differences are twice as large as a quarter of them. A reversal between
// few samples looks as rough, and its sizes go over decades.
constexpr double most_uneven = 4.0;
// It is larger than a step of the converter, which would let a channel rest at one value, and than this part of the
// span: digits and solvers leave less, a load cell more.
constexpr double least_of_span = 1e-4;
// So many of the samples are off their neighbours to the side that the motion is: half of them by chance, all where the
// noise is that of the displacement, or of the velocity, three quarters where it is half and half.
constexpr double of_motion = 0.7;

// Between any two of them.
double smallest_step(std::vector<double> values) {
  std::ranges::sort(values);
  double smallest = values.back() - values.front();
  for (std::size_t n = 1; n < values.size(); ++n) {
    if (values[n] > values[n - 1]) smallest = std::min(smallest, values[n] - values[n - 1]);
  }
  return smallest;
}

std::size_t samples_at(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::count(values, value));
}

// Of the values other than the smallest and the largest one.
std::size_t most_at_one_between(std::vector<double> values) {
  std::ranges::sort(values);
  std::size_t most = 0;
  for_each_run(values, [&](std::size_t first, std::size_t count) {
    if (first > 0 && first + count < values.size()) most = std::max(most, count);
  });
  return most;
}

// Differences of an order between neighbours of `channel`, over those samples where `force` is at neither end.
std::vector<double> differences_between_ends(const std::vector<double>& channel, const std::vector<double>& force,
                                             std::size_t order) {
  const auto [low, high] = std::ranges::minmax(force);
  std::vector<double> result;
  std::vector<double> run;
  const auto close_run = [&] {
    if (run.size() < shortest_run) run.clear();
    for (std::size_t k = 0; k < order && !run.empty(); ++k) {
      for (std::size_t n = 0; n + 1 < run.size(); ++n) run[n] = run[n + 1] - run[n];
      run.pop_back();
    }
    result.insert(result.end(), run.begin(), run.end());
    run.clear();
  };
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (force[n] == low || force[n] == high) {
      close_run();
    } else {
      run.push_back(channel[n]);
    }
  }
  close_run();
  return result;
}

bool is_of_one_size(std::vector<double> differences) {
  std::ranges::transform(differences, differences.begin(), [](double one) { return std::fabs(one); });
  std::ranges::sort(differences);
  return differences[differences.size() / 2] <= most_uneven * differences[differences.size() / 4];
}

// The divisors are the sums of squares of the binomial coefficients.
bool is_noisy_between_ends(const std::vector<double>& values) {
  std::vector<double> sixth = differences_between_ends(values, values, 6);
  if (sixth.size() < fewest_differences) return false;
  if (!is_of_one_size(sixth)) return false;
  const double noise = robust_deviation(std::move(sixth)) / std::sqrt(924.0);
  const double of_fourth = robust_deviation(differences_between_ends(values, values, 4)) / std::sqrt(70.0);
  const double step = std::max(channel_quantum(values), smallest_step(values));
  return noise >= white * of_fourth && noise > step && noise > least_of_span * span_of(values);
}

// Whether what the channel differs from its neighbours by has the sign of what the force does, in so many samples: by
// the signs, as the stiffness between the two may change.
bool goes_with_force(const std::vector<double>& channel, const std::vector<double>& force) {
  const auto of_force = differences_between_ends(force, force, 4);
  const auto of_channel = differences_between_ends(channel, force, 4);
  std::size_t alike = 0;
  for (std::size_t n = 0; n < of_force.size(); ++n) alike += of_force[n] * of_channel[n] > 0.0 ? 1 : 0;
  return static_cast<double>(alike) > of_motion * static_cast<double>(of_force.size());
}

}  // namespace

std::optional<FlatEnd> saturated_end_of(const std::vector<double>& values, double sign) {
  if (values.empty()) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(values);
  const double end = sign > 0.0 ? high : low;
  const std::size_t at = samples_at(values, end);
  const double share = static_cast<double>(at) / static_cast<double>(values.size());
  const bool often = high > low && at >= fewest_at_end && share >= least_share &&
                     static_cast<double>(at) >= more_often * static_cast<double>(most_at_one_between(values));
  return often && is_noisy_between_ends(values) ? std::optional(FlatEnd{end, share, true}) : std::nullopt;
}

bool force_noise_is_of_motion(const Recording& recording) {
  const std::size_t size = recording.force.size();
  if (recording.displacement.size() != size || recording.velocity.size() != size) return false;
  return goes_with_force(recording.displacement, recording.force) ||
         goes_with_force(recording.velocity, recording.force);
}

std::vector<FlatEnd> saturated_ends_of_force(const Recording& recording) {
  std::vector<FlatEnd> ends;
  for (const double sign : {1.0, -1.0}) {
    if (const auto end = saturated_end_of(recording.force, sign)) ends.push_back(*end);
  }
  if (ends.empty() || placeholder_of(recording.force) || force_noise_is_of_motion(recording)) return {};
  // Zeros of a channel that was off are told as such.
  if (silence_of(recording.force)) std::erase_if(ends, [](const FlatEnd& end) { return end.value == 0.0; });
  return ends;
}

}  // namespace hysteron
