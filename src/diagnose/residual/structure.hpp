// Is a residual noise, or does it repeat?
#pragma once

#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Share of a residual's energy that can be predicted from the motion: additive ridge regression on bins of displacement
// by velocity, distance since reversal by direction, and time since the last drive change by its sign, learned on all
// but one of six stretches of the recording and judged on that one. Noise of any colour, outliers and quantisation
// cannot be predicted: the share is below zero on average, and chance agreement of slow noise stays below 0.1. Slow
// trends are not seen.
// Residual in N, one per sample. Below 200 samples the answer is 0.
double predictable_share(const Recording& recording, const std::vector<double>& residual);

}  // namespace hysteron
