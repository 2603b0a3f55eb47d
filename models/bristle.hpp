// The sign of the sliding velocity as dry friction follows it: the contact bends over a length too short to be seen
// before it slides.
//   z' = (v - |v| z) / (x_b + |v| t_b)
#pragma once

#include "simulate/part.hpp"

namespace hysteron {

inline constexpr double bristle_length = 2e-5;  // m
// At speed the length alone would need steps far shorter than any sampling.
inline constexpr double bristle_time = 5e-4;  // s

template <class T>
T bristle_rate(const T& v, const T& z) {
  const T speed = abs(v);
  return (v - speed * z) / (T(bristle_length) + T(bristle_time) * speed);
}

// Bound of |dz'/dz| for speeds (m/s) up to `speed`.
inline double bristle_stiffness(double speed) { return speed / (bristle_length + bristle_time * speed); }

}  // namespace hysteron
