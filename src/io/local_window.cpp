#include "io/local_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/squared.hpp"
#include "io/local_cubic.hpp"
#include "io/neighbours.hpp"

namespace hysteron {
namespace {

// A window that takes so many times its usual time holds a gap.
constexpr double longest_within = 1.5;

// Standard deviation of the difference between the slopes of two windows around one sample, for unit noise and spacing.
double deviation_between(std::size_t longer, std::size_t shorter) {
  std::vector<double> weights = uniform_weights(longer);
  const std::vector<double> inner = uniform_weights(shorter);
  for (std::size_t j = 0; j < inner.size(); ++j) weights[longer - shorter + j] -= inner[j];
  double squares = 0.0;
  for (const double weight : weights) squares += weight * weight;
  return std::sqrt(squares);
}

// The noise about each place by what samples differ by from the quintic through their six neighbours. It may be more
// than that of the whole, as where time stamps are jittered and the motion is fast, at a glitch, or in a vibration that
// the samples hardly resolve.
class NoiseNearby {
 public:
  NoiseNearby(std::span<const double> time, std::span<const double> displacement)
      : time_(time), displacement_(displacement), squares_(time.size(), unknown) {}

  // Standard deviation, m, of the noise of samples [first, last].
  double of(std::size_t first, std::size_t last) {
    const std::size_t begin = std::max(first, quintic_reach);
    const std::size_t end = std::min(last + 1, time_.size() - quintic_reach);
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (squares_[i] == unknown) squares_[i] = squared(off_neighbours(time_, displacement_, i));
      sum += squares_[i];
    }
    return std::sqrt(sum / static_cast<double>(end - begin));
  }

 private:
  static constexpr double unknown = -1.0;

  std::span<const double> time_;
  std::span<const double> displacement_;
  std::vector<double> squares_;
};

}  // namespace

void local_window_slopes(std::span<const double> time, std::span<const double> displacement, double side,
                         double median_step, double noise, std::span<double> velocity) {
  local_cubic_slopes(time, displacement, side, median_step, noise, velocity);
  const auto longest = static_cast<std::size_t>(side);
  const std::size_t n = time.size();
  if (longest <= fewest_on_a_side || n <= 2 * longest) return;
  NoiseNearby nearby(time, displacement);
  std::vector<std::size_t> taken(n, longest);
  std::vector<double> slopes(n);
  for (std::size_t shorter = longest; shorter > fewest_on_a_side;) {
    shorter = std::max(fewest_on_a_side, shorter / 2);
    local_cubic_slopes(time, displacement, static_cast<double>(shorter), median_step, noise, slopes);
    std::vector<double> explained(longest + 1, -1.0);  // by noise of one metre, by the window that was taken
    for (std::size_t i = longest; i + longest < n; ++i) {
      // Beside a gap the cubic is off its centre, and passes on more noise than that.
      const double within = time[i + taken[i]] - time[i - taken[i]];
      if (within > longest_within * 2.0 * static_cast<double>(taken[i]) * median_step) continue;
      double& of_noise = explained[taken[i]];
      if (of_noise < 0.0) of_noise = beyond_noise * deviation_between(taken[i], shorter) / median_step;
      const double difference = std::abs(slopes[i] - velocity[i]);
      if (difference > of_noise * noise && difference > of_noise * nearby.of(i - taken[i], i + taken[i])) {
        velocity[i] = slopes[i];
        taken[i] = shorter;
      }
    }
  }
}

}  // namespace hysteron
