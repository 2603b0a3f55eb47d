#include "io/outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/drive.hpp"
#include "core/extent.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// An outlier is further from its neighbours than this many standard deviations of the noise ...
constexpr double deviations = 8.0;
// ... and this many times as far as they are from each other.
constexpr double apart = 2.0;
constexpr std::size_t fewest_samples_each = 50;
constexpr std::size_t fewest_samples = 8;

// The four samples nearest to n on both sides but for `partner` (n itself: none), and what they say of n.
struct Neighbours {
  std::array<std::size_t, 4> at;
  double told = 0.0;    // cubic interpolation
  double spread = 0.0;  // the most that one is from the next
};

Neighbours neighbours_of(std::span<const double> f, std::size_t n, std::size_t partner) {
  Neighbours result{};
  std::size_t before = n;
  std::size_t after = n;
  for (const std::size_t k : {1U, 0U}) {
    before -= before - 1 == partner ? 2 : 1;
    result.at[k] = before;
  }
  for (const std::size_t k : {2U, 3U}) {
    after += after + 1 == partner ? 2 : 1;
    result.at[k] = after;
  }
  const auto place = [&](std::size_t k) { return static_cast<double>(result.at[k]) - static_cast<double>(n); };
  for (std::size_t k = 0; k < 4; ++k) {
    double weight = 1.0;
    for (std::size_t other = 0; other < 4; ++other) {
      weight *= other == k ? 1.0 : place(other) / (place(other) - place(k));
    }
    result.told += weight * f[result.at[k]];
    result.spread = k == 0 ? 0.0 : std::max(result.spread, std::fabs(f[result.at[k]] - f[result.at[k - 1]]));
  }
  return result;
}

// How far the sample is from what its neighbours say, with its sign; 0 where that is not far.
double stands_out(std::span<const double> f, std::size_t n, std::size_t partner, double limit) {
  const Neighbours around = neighbours_of(f, n, partner);
  const double off = f[n] - around.told;
  return std::fabs(off) > std::max(limit, apart * around.spread) ? off : 0.0;
}

// Another outlier one or two samples away hides one. Two that lie side by side on the same side are a peak.
std::size_t partner_of(std::span<const double> f, std::size_t n, double limit) {
  for (const std::size_t partner : {n - 2, n - 1, n + 1, n + 2}) {
    if (partner < 3 || partner + 3 >= f.size()) {
      continue;
    }
    const double off = stands_out(f, n, partner, limit) * stands_out(f, partner, n, limit);
    const bool adjacent = partner + 1 == n || n + 1 == partner;
    if (off < 0.0 || (off > 0.0 && !adjacent)) {
      return partner;
    }
  }
  return n;
}

// Of the five samples nearest to each. One or two that stand out are never a median.
std::vector<double> medians_of_five(std::span<const double> f) {
  std::vector<double> result(f.size());
  for (std::size_t n = 0; n < f.size(); ++n) {
    const std::size_t first = std::clamp<std::size_t>(n, 2, f.size() - 3) - 2;
    std::array<double, 5> five{};
    std::ranges::copy(f.subspan(first, five.size()), five.begin());
    std::ranges::nth_element(five, five.begin() + 2);
    result[n] = five[2];
  }
  return result;
}

}  // namespace

std::vector<Outlier> outliers_of(std::span<const double> time, std::span<const double> values) {
  std::vector<Outlier> found;
  const std::size_t size = values.size();
  if (size < fewest_samples) return found;
  const double limit = deviations * channel_noise(time, values);
  const std::vector<double> medians = medians_of_five(values);
  const auto [low, high] = std::ranges::minmax(medians);
  const double span = high - low;
  if (!(span > 0.0)) return found;
  for (std::size_t n = 0; n < size; ++n) {
    std::size_t partner = n;
    bool out = false;
    if (n >= 2 && n + 2 < size && limit > 0.0) {
      out = stands_out(values, n, n, limit) != 0.0;
      if (!out && n >= 3 && n + 3 < size) {
        partner = partner_of(values, n, limit);
        out = partner != n;
      }
    }
    if (out) {
      const double told = neighbours_of(values, n, partner).told;
      found.push_back({n, told, std::fabs(values[n] - told) > span});
    } else if (std::fabs(values[n] - medians[n]) > std::max(limit, span)) {
      found.push_back({n, medians[n], true});
    }
  }
  if (found.size() * fewest_samples_each > size) found.clear();
  return found;
}

std::vector<Outlier> outliers_of_setting(const std::vector<double>& values) {
  constexpr double far_from_level = 0.5;
  std::vector<Outlier> found;
  if (values.size() < fewest_samples) return found;
  const std::vector<double> medians = medians_of_five(values);
  const double level = peak_of(medians);
  if (!(level > 0.0)) return found;
  const double limit = std::max({span_of(medians), far_from_level * level, deviations * drive_noise(values)});
  // A channel that begins or ends a sample late is none that strays, unless it goes beyond what lies between off and
  // its levels.
  const auto [low, high] = std::ranges::minmax(medians);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const bool at_an_end = n < 2 || n + 2 >= values.size();
    const double off = at_an_end ? std::max(std::min(low, 0.0) - values[n], values[n] - std::max(high, 0.0))
                                 : std::fabs(values[n] - medians[n]);
    if (off > limit) found.push_back({n, medians[n], true});
  }
  if (found.size() * fewest_samples_each > values.size()) found.clear();
  return found;
}

std::size_t replace_outliers(Recording& recording) {
  const std::vector<Outlier> found = outliers_of(recording.time, recording.force);
  for (const Outlier& one : found) recording.force[one.at] = one.told;
  return found.size();
}

}  // namespace hysteron
