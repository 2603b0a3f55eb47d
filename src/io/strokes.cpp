#include "io/strokes.hpp"

#include <cmath>

#include "core/extent.hpp"

namespace hysteron {

std::size_t samples_a_stroke(std::span<const double> values) {
  constexpr double least_stroke = 0.1;
  const double least = least_stroke * span_of(values);
  double furthest = values.front();
  double sign = 0.0;  // of the stroke that goes on
  std::size_t strokes = 1;
  for (const double value : values) {
    if (sign == 0.0 && std::fabs(value - furthest) > least) sign = std::copysign(1.0, value - furthest);
    if (sign * (furthest - value) > least) {
      ++strokes;
      sign = -sign;
      furthest = value;
    } else if (sign * (value - furthest) > 0.0) {
      furthest = value;
    }
  }
  return values.size() / strokes;
}

}  // namespace hysteron
