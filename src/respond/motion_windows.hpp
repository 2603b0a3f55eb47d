// Channels of a motion in windows as long as its period, in which they can be held against derivatives of the
// displacement without differentiating it: over a window whose weight w and its slopes vanish at both ends the integral
// of w x'' is that of w'' x (integration by parts), and the noise of x is averaged as much as that of x'' is.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

class MotionWindows {
 public:
  // Of the displacement's dominant period, or a quarter of the recording where it never turns; none across gaps.
  explicit MotionWindows(const Recording& recording);

  // Fewer tell nothing: they overlap, and this is two periods.
  static constexpr std::size_t fewest = 8;
  [[nodiscard]] bool few() const;

  // Weighted means, one a window, of a channel and of its first and second derivative.
  [[nodiscard]] std::vector<double> means_of(std::span<const double> channel) const;
  [[nodiscard]] std::vector<double> slopes_of(std::span<const double> channel) const;
  [[nodiscard]] std::vector<double> bends_of(std::span<const double> channel) const;
  // Standard deviation that white noise of 1 in a channel has in these.
  [[nodiscard]] double noise_of_means() const;
  [[nodiscard]] double noise_of_bends() const;

 private:
  struct Window {
    std::size_t first;
    std::size_t end;
    double middle;  // s
  };
  template <class Weight>
  [[nodiscard]] std::vector<double> weighted(std::span<const double> channel, Weight&& weight) const;
  template <class Weight>
  [[nodiscard]] double noise_of(Weight&& weight) const;

  std::vector<double> time_;
  std::vector<double> step_;  // s, that each sample stands for
  double half_ = 0.0;         // length of a window, s
  std::vector<Window> windows_;
};

// How one series follows another, the means of both aside.
struct Following {
  double gain = 0.0;    // of the regression that takes both for noisy; negative: reversed
  double shared = 0.0;  // square of their correlation
  double offset = 0.0;  // mean of what follows, less gain times that of what is followed
  double misfit = 0.0;  // mean square of the difference, gain 1, over that of what follows
};
Following following_of(std::span<const double> what, std::span<const double> follows);

double mean_square_about_mean(std::span<const double> values);

}  // namespace hysteron
