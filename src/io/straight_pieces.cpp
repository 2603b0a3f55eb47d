#include "io/straight_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "io/strokes.hpp"

namespace hysteron {
namespace {

// The samples that are looked at, from the middle of the channel: enough for hundreds of the longest pieces.
constexpr std::size_t most_looked_at = 65536;

// A displacement of 10 Hz at 1 kHz has pieces of 100 samples. Shorter than a quarter of a stroke each, since a triangle
// is one piece a stroke and a trapezoid two.
constexpr std::size_t longest_piece = 100;
constexpr std::size_t fewest_a_stroke = 4;
// With two bent samples a piece, so many leave two straight ones at least.
constexpr std::size_t shortest_between_samples = 4;

// A quarter of the bends may be lost in the rounding, as where a sine passes its middle. The others are so many times
// larger than 19 of 20 of what is left in between, which is rounding: of samples that are all alike they would be
// smaller.
constexpr double lost_bends = 0.25;
constexpr double straight = 0.95;
constexpr double larger = 3.0;

// There are so many bends, of so many sizes: a programme of ramps and holds of one duration bends by one amount.
constexpr std::size_t fewest_bends = 30;
constexpr std::size_t fewest_sizes = 10;
// Sizes that are nearer than this part of the largest are one.
constexpr double same_size = 1e-6;

double quantile_of(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

// Second differences.
std::vector<double> bends_of(std::span<const double> values) {
  std::vector<double> bends;
  for (std::size_t n = 1; n + 1 < values.size(); ++n) {
    bends.push_back(values[n + 1] - 2.0 * values[n] + values[n - 1]);
  }
  return bends;
}

// Whether two samples of five are straight beside the bends of the longest pieces, as with pieces of any length.
bool is_straight_in_parts(std::vector<double> bends) {
  constexpr double two_of_five = 0.4;
  constexpr double but_few = 1.0 - 0.5 / static_cast<double>(longest_piece);
  for (double& bend : bends) bend = std::fabs(bend);
  const double rounding = quantile_of(bends, two_of_five);
  return larger * rounding < quantile_of(bends, but_few);
}

std::size_t sizes_of(std::vector<double> bends, double rounding) {
  std::ranges::sort(bends);
  const double nearer = std::max(rounding, same_size * bends.back());
  std::size_t count = 0;
  double last = 0.0;
  for (const double bend : bends) {
    if (bend - last <= nearer) continue;
    ++count;
    last = bend;
  }
  return count;
}

// Whether the bends lie on `width` samples side by side of every `length`, and all others are straight. The step from
// one held value to the next is two bends against each other, and none together.
bool has_pieces(const std::vector<double>& bends, std::size_t length, std::size_t width) {
  std::vector<double> sums(length, 0.0);
  for (std::size_t n = 0; n < bends.size(); ++n) sums[n % length] += std::fabs(bends[n]);
  const auto of = [&](std::size_t phase) {
    return width == 1 ? sums[phase] : sums[phase] + sums[(phase + 1) % length];
  };
  std::size_t best = 0;
  for (std::size_t phase = 1; phase < length; ++phase) best = of(phase) > of(best) ? phase : best;
  if (2.0 * of(best) < std::accumulate(sums.begin(), sums.end(), 0.0)) return false;
  std::vector<double> bent;
  std::vector<double> between;
  for (std::size_t n = 0; n < bends.size(); ++n) {
    const std::size_t behind = (n % length + length - best) % length;
    if (behind >= width) {
      between.push_back(std::fabs(bends[n]));
    } else if (behind == 0 && n + width <= bends.size()) {
      bent.push_back(std::fabs(width == 1 ? bends[n] : bends[n] + bends[n + 1]));
    }
  }
  if (bent.size() < fewest_bends) return false;
  const double rounding = larger * quantile_of(between, straight);
  return quantile_of(bent, lost_bends) > rounding && sizes_of(bent, rounding) >= fewest_sizes;
}

}  // namespace

std::optional<std::size_t> straight_pieces_of(const std::vector<double>& values) {
  if (values.size() < fewest_bends) return std::nullopt;
  const std::size_t count = std::min(values.size(), most_looked_at);
  const std::span<const double> some = std::span(values).subspan((values.size() - count) / 2, count);
  const std::vector<double> bends = bends_of(some);
  if (!is_straight_in_parts(bends)) return std::nullopt;
  const std::size_t longest = std::min(longest_piece, samples_a_stroke(some) / fewest_a_stroke);
  for (std::size_t length = 2; length <= longest; ++length) {
    if (has_pieces(bends, length, 1) || (length >= shortest_between_samples && has_pieces(bends, length, 2))) {
      return length;
    }
  }
  return std::nullopt;
}

}  // namespace hysteron
