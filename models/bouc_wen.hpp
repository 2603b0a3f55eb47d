// The hysteresis of Bouc and Wen in normal form, for the laws that have it in their equations.
//   z' = (v - |z|^n (share |v| sgn(z) + (1 - share) v)) / x_y,   |z| <= 1
#pragma once

#include "simulate/part.hpp"

namespace hysteron {

// share |v| sgn(z) + (1 - share) v, which holds z back as it nears its limit.
template <class T>
[[gnu::always_inline]] inline T against(const T& share, const T& z, const T& v) {
  return share * select(z < T(0.0), -abs(v), abs(v)) + (T(1.0) - share) * v;
}

// Its largest size over |v|; 1 while z and v have one sign.
template <class T>
[[gnu::always_inline]] inline T steepest(const T& share) {
  return max(T(1.0), abs(T(1.0) - T(2.0) * share));
}

}  // namespace hysteron
