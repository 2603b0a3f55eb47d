// Amplitude, frequency and phase of a recorded sine, by Nelder and Mead as the identification that fits them first
// does.
#pragma once

#include "core/recording.hpp"

namespace hysteron {

// x(t) = amplitude sin(2 pi frequency t + phase) + middle; the middle is that of the extremes and is not searched.
struct SineFit {
  double amplitude;  // m
  double frequency;  // Hz
  double phase;      // rad, 0 to 2 pi
  double middle;     // m
  double rms;        // m, of what the sine leaves
};

// Least squares over the displacement within `budget` evaluations. Throws InputError for a recording without a whole
// period.
[[nodiscard]] SineFit fit_sine(const Recording& recording, std::size_t budget = 2000);

// The recording with displacement, velocity and acceleration of the sine about zero in place of the recorded ones.
[[nodiscard]] Recording with_motion_of(const SineFit& sine, Recording recording);

}  // namespace hysteron
