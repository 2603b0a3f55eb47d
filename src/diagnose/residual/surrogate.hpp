// What a bond between a residual and the motion would be by chance: the residual cut into half cycles, each of which is
// shifted against the motion by its own random part and given a random sign. Within a half cycle the noise keeps its
// colour and its size; what repeats from one to the next, as everything that follows the motion does on a sine, is
// scattered. A shift of the whole would only move that to another phase.
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.hpp"
#include "core/recording.hpp"

namespace hysteron {

// First samples of the half cycles of a recording from sample `from` on, counted from there, and the number of samples
// at the end: of equal duration, the shortest that holds sixteen samples. Eight blocks where the motion never turns.
std::vector<std::size_t> half_cycles(const Recording& recording, std::size_t from);

// Values from the first sample that counts on, cut at `blocks`.
std::vector<double> surrogate(const std::vector<double>& values, const std::vector<std::size_t>& blocks,
                              const Stream& stream);

}  // namespace hysteron
