// The strokes that a channel makes.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron {

// Samples of the channel over its strokes, which a reversal by more than a tenth of its span ends.
std::size_t samples_a_stroke(std::span<const double> values);

}  // namespace hysteron
