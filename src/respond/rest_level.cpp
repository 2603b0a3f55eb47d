#include "respond/rest_level.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/extent.hpp"
#include "core/mean.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr double last_part = 0.125;  // of the samples
// Of the largest distance, within which it is at rest: what is looked for in levels is no finer.
constexpr double rest_share = 0.01;
constexpr double surely = 6.0;  // standard deviations of the noise

// The larger of the last two turns that noise does not make; the largest of all where there are fewer.
double last_swings(std::span<const double> x, const RestLevel& rest) {
  constexpr double rounding = 1e-3;  // of the largest: a tenth of what is at rest
  const double least = std::max(surely * rest.noise, rounding * rest.largest);
  double result = 0.0;
  int changes = 0;
  bool above = false;
  for (std::size_t n = x.size(); n-- > 0;) {
    const double off = x[n] - rest.level;
    if (std::fabs(off) <= least) continue;
    if (changes == 0 || above != (off > 0.0)) ++changes;
    above = off > 0.0;
    if (changes == 3) return result;
    result = std::max(result, std::fabs(off));
  }
  return rest.largest;
}

}  // namespace

std::optional<RestLevel> rest_level_of(const Recording& recording) {
  const std::span<const double> x(recording.displacement);
  const auto count = static_cast<std::size_t>(last_part * static_cast<double>(x.size()));
  if (count == 0) return std::nullopt;
  const std::span<const double> last = x.last(count);
  RestLevel result{mean_of(last), channel_noise(recording.time, x), 0.0, 0.0};
  for (const double value : x) result.largest = std::max(result.largest, std::fabs(value - result.level));
  if (span_of(last) > 2.0 * std::max(rest_share * result.largest, surely * result.noise)) return std::nullopt;
  result.last_swings = last_swings(x, result);
  return result;
}

}  // namespace hysteron
