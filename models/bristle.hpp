// The sign of the sliding velocity as dry friction follows it: the contact bends over a length x_b before it slides,
// from less than can be seen to tenths of a millimetre of a soft seal.
//   z' = (v - |v| z) / (x_b + |v| t_b)
// On a film of lubricant the friction is less than full below a speed v_t: z tanh(|v| / v_t). Where x_b is small this
// is the smooth sign tanh(v / v_t) that stands for dry friction in many simulations.
#pragma once

#include "simulate/part.hpp"

namespace hysteron {

// At speed the length alone would need steps far shorter than any sampling.
inline constexpr double bristle_time = 5e-4;  // s

inline constexpr Parameter bristle_length = {.name = "x_b", .unit = "m", .meaning = "length over which the contact bends", .box = {1e-7, 2e-4}, .initial = 2e-5, .scale = Scale::logarithmic};

// At its lower end the film changes nothing.
inline constexpr Parameter film_speed = {.name = "v_t", .unit = "m/s", .meaning = "speed below which the friction is less than full", .box = {1e-5, 0.02}, .initial = 1e-4, .scale = Scale::logarithmic};

template <class T>
T bristle_rate(const T& length, const T& v, const T& z) {
  const T speed = abs(v);
  return (v - speed * z) / (length + T(bristle_time) * speed);
}

// Part of the friction that a film leaves.
template <class T>
T on_film(const T& film, const T& v) {
  return tanh(abs(v) / film);
}

// Bound of |dz'/dz| for speeds (m/s) up to `speed`.
template <class T>
T bristle_stiffness(const T& length, double speed) {
  return T(speed) / (length + T(bristle_time) * T(speed));
}

}  // namespace hysteron
