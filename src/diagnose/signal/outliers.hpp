// Samples of the force that stand out alone: of the recording chain, not of the damper.
#pragma once

#include <cstddef>

#include "core/recording.hpp"

namespace hysteron {

// Replaces each force sample that lies far from what its four neighbours say, where these agree among each other, by
// what they say (cubic interpolation, as of even spacing); their number. So are two that hide each other, one or two
// samples apart. A step, a kink and a peak of several samples are no outliers. Where more than one sample of fifty
// would be one, nothing is replaced: that is how the force is.
std::size_t replace_outliers(Recording& recording);

}  // namespace hysteron
