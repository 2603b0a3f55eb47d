// Size of an effect in each part of the recordings, where one size fits all of them together, and how even it is.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron {

// Parts are the quarters of the phase plane (below or above the middle of the stroke, either direction) of a recording.
struct SizeOfPart {
  std::size_t recording = 0;
  int quarter = 0;      // 0 to 3: above the middle adds one, the positive direction two
  double size = 0.0;    // one where the effect is as large as over all
  double weight = 0.0;  // mean square of what the effect does there, over the samples of the recording
};

// How even: (sum w b)^2 / (sum w sum w b^2), the share of what sizes of its own in each part would take off that one
// size takes off; 0 where the sum is negative, and for no parts.
double evenness_of(std::span<const SizeOfPart> parts);

}  // namespace hysteron
