#include "core/part_size.hpp"

#include <cmath>

#include "core/squared.hpp"

namespace hysteron {

double evenness_of(std::span<const SizeOfPart> parts) {
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const SizeOfPart& part : parts) {
    weights += part.weight;
    sum += part.weight * part.size;
    squares += part.weight * squared(part.size);
  }
  return sum > 0.0 && std::isfinite(squares) ? squared(sum) / (weights * squares) : 0.0;
}

}  // namespace hysteron
