// How often a recorded motion turns.
#pragma once

#include "core/recording.hpp"

namespace hysteron {

// Frequency in Hz of the motion between its first and last turning points: of the half periods that are like their
// median, so that a rest or a sweep does not count, on average, which no sampling rounds. Where harmonics, a second
// tone or noise make it turn at other times too, that of the sine that is nearly all of the displacement, beside a
// drift, if one is; else, where most half periods are not alike, that of whole periods, if these are. 0 when it never
// turns.
double dominant_frequency(const Recording& recording);

// Whether the motion turns a single time, so that no half period tells its frequency: 0 is not it.
bool turns_once(const Recording& recording);

}  // namespace hysteron
