#include "io/held_ends.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/robust.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// Noise of half a step of the converter takes another value in every third sample: with ten samples at one value by
// chance in a recording of a hundred. It holds elsewhere for this part of the time at most.
constexpr std::size_t fewest = 10;
constexpr double elsewhere = 0.25;
constexpr double least_noise = 0.5;  // of a step; rounding alone is 0.3
// Of noise every order of differences tells the same deviation, of a smooth force the higher one tells less.
constexpr double white = 0.85;

// Standard deviation of white noise, by differences of an order between neighbours; `of_noise` is the sum of squares of
// the binomial coefficients.
double noise_by_differences(std::vector<double> values, int order, double of_noise) {
  for (int k = 0; k < order; ++k) {
    for (std::size_t n = 0; n + 1 < values.size(); ++n) values[n] = values[n + 1] - values[n];
    values.pop_back();
  }
  return robust_deviation(std::move(values)) / std::sqrt(of_noise);
}

bool is_noisy(std::span<const double> values) {
  const std::vector<double> copy(values.begin(), values.end());
  const double fourth = noise_by_differences(copy, 4, 70.0);
  const double sixth = noise_by_differences(copy, 6, 924.0);
  return sixth > 0.0 && sixth >= white * fourth && sixth >= least_noise * channel_quantum(values);
}

}  // namespace

std::optional<HeldEnd> held_end_of(const Recording& recording) {
  const std::size_t size = recording.size();
  if (size < 2 * fewest || recording.displacement.size() != size || recording.force.size() != size) return std::nullopt;
  const auto same = [&](std::size_t n) {  // as the sample before
    return recording.displacement[n] == recording.displacement[n - 1] && recording.force[n] == recording.force[n - 1];
  };
  std::size_t at_start = 1;
  while (at_start < size && same(at_start)) ++at_start;
  std::size_t at_end = 1;
  while (at_end < size && same(size - at_end)) ++at_end;
  const HeldEnd held{at_start > at_end, std::max(at_start, at_end)};
  if (held.count < fewest || held.count == size) return std::nullopt;
  std::size_t longest = 1;  // between both
  std::size_t run = 1;
  for (std::size_t n = at_start + 1; n + at_end < size; ++n) {
    run = same(n) ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  if (static_cast<double>(longest) > elsewhere * static_cast<double>(held.count)) return std::nullopt;
  // A rod that rests, under a force without noise, holds both.
  if (at_start + at_end + fewest > size) return std::nullopt;
  const bool noisy = is_noisy(std::span(recording.force).subspan(at_start, size - at_end - at_start));
  return noisy ? std::optional(held) : std::nullopt;
}

}  // namespace hysteron
