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

std::vector<SizeOfPart> by_recording(std::span<const SizeOfPart> parts) {
  std::vector<SizeOfPart> result;
  for (const SizeOfPart& part : parts) {
    if (result.empty() || result.back().recording != part.recording) {
      result.push_back({part.recording, 0, 0.0, 0.0});
    }
    SizeOfPart& whole = result.back();
    whole.size = (whole.size * whole.weight + part.size * part.weight) / (whole.weight + part.weight);
    whole.weight += part.weight;
  }
  return result;
}

}  // namespace hysteron
