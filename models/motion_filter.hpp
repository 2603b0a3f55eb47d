// Acceleration from a first-order lag of the velocity, for parts that need more of the motion than x and v.
// A part keeps h' = (v - h) / tau from h = 0. For a velocity v = v0 + a t since the march began,
//   h = v0 (1 - e) + a (t - tau (1 - e)),   e = exp(-t / tau),
// so that a = (v (1 - e) - h) / (tau (1 - e) - t e), which turns into (v - h) / tau: no transient of the start at rest.
#pragma once

#include "simulate/part.hpp"

namespace hysteron {

// tau, and the a_s of the smooth sign tanh(a / a_s).
inline constexpr Parameter acceleration_lag = {.name = "tau", .unit = "s", .meaning = "time constant of the acceleration estimate", .box = {5e-4, 0.02}, .initial = 2e-3, .scale = Scale::logarithmic, .fixed = true};
inline constexpr Parameter acceleration_rounding = {.name = "a_s", .unit = "m/s^2", .meaning = "acceleration at which its sign is rounded", .box = {0.01, 5}, .initial = 0.2, .scale = Scale::logarithmic, .fixed = true};

// Error for a sine of frequency w: a lag of tau. `age` is the time since the march began, which is not the start of the
// recording where a period is marched beforehand (Input::age); zero at its very start, where h says nothing yet.
template <class T>
T acceleration(const T& v, const T& h, const T& tau, const T& age) {
  const T fading = exp(-age / tau);
  const T grown = T(1.0) - fading;
  const auto young = age < T(1e-3) * tau;
  const T span = select(young, T(1.0), tau * grown - age * fading);
  return select(young, T(0.0), (v * grown - h) / span);
}

}  // namespace hysteron
