// Acceleration from a first-order lag of the velocity, for parts that need more of the motion than x and v.
// A part keeps h' = (v - h) / tau from h = 0. For a velocity v = v0 + a t since the march began,
//   h = v0 (1 - e) + a (t - tau (1 - e)),   e = exp(-t / tau),
// so that a = (v (1 - e) - h) / (tau (1 - e) - t e), which turns into (v - h) / tau: no transient of the start at rest.
#pragma once

#include "simulate/part.hpp"

namespace hysteron {

// Error for a sine of frequency w: a lag of tau. Zero at the very start of a recording, where h says nothing yet.
template <class T>
T acceleration(const T& v, const T& h, const T& tau, const T& time) {
  const T age = time / tau;
  const T fading = exp(-age);
  const T grown = T(1.0) - fading;
  const auto young = age < T(1e-3);
  const T span = select(young, T(1.0), tau * grown - time * fading);
  return select(young, T(0.0), (v * grown - h) / span);
}

// With a second lag g' = (h - g) / tau: the lag of tau is compensated, relative error (w tau)^2.
template <class T>
T acceleration(const T& v, const T& h, const T& g, const T& tau, const T& time) {
  const T age = time / tau;
  const T a = acceleration(v, h, tau, time);
  const T start = v - a * time;
  const T transient = exp(-age) * (start * (T(1.0) - age) + a * time);
  return a + select(age < T(1e-3), T(0.0), (v - T(2.0) * h + g - transient) / tau);
}

}  // namespace hysteron
