// How a recording begins: from rest, within its cycle, or at full speed with a force that builds up from nothing.
#pragma once

#include <cstddef>

#include "core/recording.hpp"

namespace hysteron {

// Samples of the first period when a recording starts in mid-motion and the motion repeats itself, so that marching
// them first brings the hysteresis into its cycle; 0 when it starts at rest or does not repeat.
std::size_t returns_after(const Recording& recording, double frequency);

// The same, or else that of a motion with harmonics or of several tones, which comes again twice at least: its turning
// points tell nothing of its period.
std::size_t period_of(const Recording& recording, double frequency);

// What the force says of the start. A recording without force, or with less than two periods, counts as in its cycle.
Start start_of(const Recording& recording);

}  // namespace hysteron
