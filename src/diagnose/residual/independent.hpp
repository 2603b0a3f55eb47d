// How many independent values a residual holds, whatever the sampling rate.
#pragma once

#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// Values of a residual for each half cycle of the motion that count at most. Hypotheses differ by forces that are
// functions of the motion, and a half cycle has so many features: the narrowest that effects make, after a reversal, is
// a twentieth of the stroke or a seventh of a sine's half cycle, over which 24 values still set three. White noise
// sampled faster tells no more of them.
constexpr double values_per_half_cycle = 24.0;

// Integrated autocorrelation time in s of the samples that count: the integral of the autocorrelation over all lags,
// which are summed in pairs while these are positive (Geyer, Statistical Science 7 (1992) 473), up to a quarter of the
// recording. Lags grow by a sixteenth from 32 samples on. Time may be unevenly spaced. 0 for fewer than 8 samples and
// for a residual that is zero.
double correlation_time(const std::vector<double>& time, const Residual& residual);

// Duration over the largest of the correlation time, what a value of the motion lasts and what a sample does.
double independent_values(const Recording& recording, const Residual& residual);

}  // namespace hysteron
