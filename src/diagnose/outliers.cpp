#include "diagnose/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/velocity.hpp"

namespace hysteron {
namespace {

// An outlier is further from its neighbours than this many standard deviations of the noise ...
constexpr double deviations = 8.0;
// ... and this many times as far as they are from each other.
constexpr double apart = 2.0;
constexpr std::size_t fewest_samples_each = 50;

}  // namespace

std::size_t replace_outliers(Recording& recording) {
  std::vector<double>& f = recording.force;
  if (f.size() < 8) {
    return 0;
  }
  const double limit = deviations * channel_noise(recording.time, f);
  std::vector<std::pair<std::size_t, double>> found;
  for (std::size_t n = 2; n + 2 < f.size(); ++n) {
    const double told = (4.0 * (f[n - 1] + f[n + 1]) - f[n - 2] - f[n + 2]) / 6.0;
    const double spread =
        std::max({std::fabs(f[n + 1] - f[n - 1]), std::fabs(f[n - 1] - f[n - 2]), std::fabs(f[n + 2] - f[n + 1])});
    if (std::fabs(f[n] - told) > std::max(limit, apart * spread) && limit > 0.0) {
      found.emplace_back(n, told);
    }
  }
  if (found.size() * fewest_samples_each > f.size()) {
    return 0;
  }
  for (const auto& [n, told] : found) {
    f[n] = told;
  }
  return found.size();
}

}  // namespace hysteron
