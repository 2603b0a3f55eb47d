#include "respond/motion_windows.hpp"

#include <algorithm>
#include <cmath>

#include "core/frequency.hpp"
#include "core/mean.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

// Windows begin so often in each of them: those of a sine half a period apart would all see it at its zeros.
constexpr double starts_a_window = 8.0;
// By which the sums stand for the integrals of a weight that is bent this little.
constexpr std::size_t fewest_samples_of_window = 16;
constexpr double windows_without_turns = 4.0;

// (1 - s^2)^4 on [-1, 1]: it, its slope and its bend are zero at both ends.
double weight_at(double s) { return squared(squared(1.0 - s * s)); }
double slope_at(double s) { return -8.0 * s * (1.0 - s * s) * squared(1.0 - s * s); }
double bend_at(double s) { return squared(1.0 - s * s) * (48.0 * s * s - 8.0 * (1.0 - s * s)); }

}  // namespace

MotionWindows::MotionWindows(const Recording& recording) : time_(recording.time) {
  const std::size_t size = time_.size();
  if (size < fewest_samples_of_window) return;
  step_.resize(size);
  for (std::size_t n = 0; n < size; ++n) {
    step_[n] = 0.5 * (time_[std::min(n + 1, size - 1)] - time_[n == 0 ? 0 : n - 1]);
  }
  const double duration = time_.back() - time_.front();
  const double frequency = dominant_frequency(recording);
  const double shortest = duration * static_cast<double>(fewest_samples_of_window) / static_cast<double>(size - 1);
  const double length = std::max(frequency > 0.0 ? 1.0 / frequency : duration / windows_without_turns, shortest);
  half_ = 0.5 * length;
  const auto count = static_cast<std::size_t>(std::max(0.0, starts_a_window * (duration / length - 1.0)) + 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    const double from = time_.front() + static_cast<double>(k) * length / starts_a_window;
    const auto first = std::ranges::lower_bound(time_, from);
    const auto end = std::upper_bound(first, time_.end(), from + length);
    const Window window{static_cast<std::size_t>(first - time_.begin()), static_cast<std::size_t>(end - time_.begin()),
                        from + half_};
    if (end - first < static_cast<std::ptrdiff_t>(fewest_samples_of_window) - 1) continue;
    const double longest = std::ranges::max(std::span(step_).subspan(window.first, window.end - window.first));
    if (longest < length / starts_a_window && from + length <= time_.back()) windows_.push_back(window);
  }
}

bool MotionWindows::few() const { return windows_.size() < fewest; }

template <class Weight>
std::vector<double> MotionWindows::weighted(std::span<const double> channel, Weight&& weight) const {
  std::vector<double> result;
  for (const Window& window : windows_) {
    double sum = 0.0;
    double whole = 0.0;
    for (std::size_t n = window.first; n < window.end; ++n) {
      const double s = std::clamp((time_[n] - window.middle) / half_, -1.0, 1.0);
      sum += weight(s) * step_[n] * channel[n];
      whole += weight_at(s) * step_[n];
    }
    result.push_back(sum / whole);
  }
  return result;
}

std::vector<double> MotionWindows::means_of(std::span<const double> channel) const {
  return weighted(channel, weight_at);
}

std::vector<double> MotionWindows::slopes_of(std::span<const double> channel) const {
  return weighted(channel, [this](double s) { return -slope_at(s) / half_; });
}

std::vector<double> MotionWindows::bends_of(std::span<const double> channel) const {
  // The sums of the bent weight are zero but for what the steps leave, which a large mean would multiply.
  std::vector<double> about(channel.begin(), channel.end());
  const double mean = mean_of(channel);
  for (double& value : about) value -= mean;
  return weighted(about, [this](double s) { return bend_at(s) / squared(half_); });
}

template <class Weight>
double MotionWindows::noise_of(Weight&& weight) const {
  double largest = 0.0;
  for (const Window& window : windows_) {
    double sum = 0.0;
    double whole = 0.0;
    for (std::size_t n = window.first; n < window.end; ++n) {
      const double s = std::clamp((time_[n] - window.middle) / half_, -1.0, 1.0);
      sum += squared(weight(s) * step_[n]);
      whole += weight_at(s) * step_[n];
    }
    largest = std::max(largest, std::sqrt(sum) / whole);
  }
  return largest;
}

double MotionWindows::noise_of_means() const { return noise_of(weight_at); }

double MotionWindows::noise_of_bends() const {
  return noise_of([this](double s) { return bend_at(s) / squared(half_); });
}

Following following_of(std::span<const double> what, std::span<const double> follows) {
  const double mean = mean_of(what);
  const double mean_of_follows = mean_of(follows);
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t n = 0; n < what.size(); ++n) {
    const double x = what[n] - mean;
    const double y = follows[n] - mean_of_follows;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  Following result;
  if (!(xx > 0.0) || !(yy > 0.0)) return result;
  result.gain = std::copysign(std::sqrt(yy / xx), xy);
  result.shared = xy * xy / (xx * yy);
  result.offset = mean_of_follows - result.gain * mean;
  result.misfit = (xx - 2.0 * xy + yy) / yy;
  return result;
}

double mean_square_about_mean(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += squared(value - mean);
  return sum / static_cast<double>(values.size());
}

}  // namespace hysteron
