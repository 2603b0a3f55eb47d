// A recording among others whose displacement or force has another unit, told by the noise of its sensor.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Remarks of recordings of which one channel is ten, 25.4 or a hundred times as large, or as small, as a unit would
// make it: with that unit it has the figures of all others, and so has its noise. By the figures alone it may well be
// another test: ten times the stroke, or a harder setting. But the noise of a sensor does not grow with what it
// measures, which the other recordings have to show: without that nothing is said.
std::vector<Remark> remarks_on_scaled_channels(const std::vector<Recording>& recordings);

}  // namespace hysteron
