#include "io/stillness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mean.hpp"
#include "core/squared.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr std::size_t block = 16;
constexpr std::size_t fewest_blocks = 3;
constexpr double surely = 4.0;          // standard errors
constexpr double surely_moved = 20.0;   // standard deviations of the noise
constexpr double no_further_off = 3.0;  // likewise, of the samples that a stretch is extended by at its ends

// Whether samples of noise `sigma` about a parabola in their number show neither slope nor bend. Legendre's polynomials
// of degree one and two over the block are orthogonal.
bool is_level(std::span<const double> x, double sigma) {
  const auto n = static_cast<double>(x.size());
  double slope = 0.0;
  double bend = 0.0;
  double of_slope = 0.0;  // sums of squares of the polynomials
  double of_bend = 0.0;
  const double spread = (n * n - 1.0) / 12.0;  // mean of u^2
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = static_cast<double>(k) - 0.5 * (n - 1.0);
    const double q = u * u - spread;
    slope += u * x[k];
    bend += q * x[k];
    of_slope += u * u;
    of_bend += q * q;
  }
  return std::fabs(slope) < surely * sigma * std::sqrt(of_slope) &&
         std::fabs(bend) < surely * sigma * std::sqrt(of_bend);
}

// Whether blocks [first, end) of the displacement scatter about one mean as noise does.
bool has_one_mean(std::span<const double> x, std::size_t first, std::size_t end, double sigma) {
  const double mean = mean_of(x.subspan(first * block, (end - first) * block));
  double sum = 0.0;
  for (std::size_t k = first; k < end; ++k) {
    sum += squared(mean_of(x.subspan(k * block, block)) - mean);
  }
  const double chi_squared = sum / (squared(sigma) / static_cast<double>(block));
  const auto degrees = static_cast<double>(end - first - 1);
  return chi_squared < degrees + surely * std::sqrt(2.0 * degrees);
}

// A rod that leaves does not come back: one sample further off than noise mostly is, and the next one not, is noise.
Still extended(Still still, std::span<const double> x, double sigma) {
  const double mean = mean_of(x.subspan(still.first, still.end - still.first));
  const auto near = [&](std::size_t n) { return n < x.size() && std::fabs(x[n] - mean) < no_further_off * sigma; };
  for (;;) {
    if (still.first > 0 && near(still.first - 1)) {
      still.first -= 1;
    } else if (still.first > 1 && near(still.first - 2)) {
      still.first -= 2;
    } else {
      break;
    }
  }
  for (;;) {
    if (near(still.end)) {
      still.end += 1;
    } else if (near(still.end + 1)) {
      still.end += 2;
    } else {
      break;
    }
  }
  return still;
}

// Whether the rod creeps from one stretch to the next.
bool creeps(const Still& a, const Still& b, std::span<const double> x, double sigma) {
  const double apart = mean_of(x.subspan(a.first, a.end - a.first)) - mean_of(x.subspan(b.first, b.end - b.first));
  const auto samples = static_cast<double>(std::min(a.end - a.first, b.end - b.first));
  if (std::fabs(apart) < surely * sigma * std::sqrt(2.0 / samples)) {
    return false;
  }
  const auto [least, most] = std::ranges::minmax(x.subspan(a.first, b.end - a.first));
  return most - least < surely_moved * sigma;
}

}  // namespace

std::vector<Still> still_stretches(std::span<const double> time, std::span<const double> displacement) {
  const double sigma = displacement.size() < fewest_blocks * block ? 0.0 : channel_noise(time, displacement);
  if (!(sigma > 0.0)) {
    return {};
  }
  const auto [least, most] = std::ranges::minmax(displacement);
  if (most - least < surely_moved * sigma) {
    return {};
  }
  std::vector<Still> stretches;
  const std::size_t blocks = displacement.size() / block;
  std::size_t first = 0;
  for (std::size_t k = 0; k <= blocks; ++k) {
    if (k < blocks && is_level(displacement.subspan(k * block, block), sigma)) {
      continue;
    }
    if (k >= first + fewest_blocks && has_one_mean(displacement, first, k, sigma)) {
      stretches.push_back(extended({first * block, k * block}, displacement, sigma));
    }
    first = k + 1;
  }
  std::vector<Still> result;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const bool from_before = k > 0 && creeps(stretches[k - 1], stretches[k], displacement, sigma);
    const bool to_next = k + 1 < stretches.size() && creeps(stretches[k], stretches[k + 1], displacement, sigma);
    if (!from_before && !to_next) {
      result.push_back(stretches[k]);
    }
  }
  return result;
}

void hold_still(Recording& recording) {
  const std::vector<Still> stretches = still_stretches(recording.time, recording.displacement);
  if (stretches.empty()) {
    return;
  }
  const double most = recording.velocity_measured ? surely * channel_noise(recording.time, recording.velocity)
                                                  : std::numeric_limits<double>::infinity();
  for (const Still& still : stretches) {
    for (std::size_t n = still.first; n < still.end; ++n) {
      if (std::fabs(recording.velocity[n]) <= most) {
        recording.velocity[n] = 0.0;
        if (!recording.derived_acceleration.empty()) {
          recording.derived_acceleration[n] = 0.0;
        }
      }
    }
  }
}

}  // namespace hysteron
