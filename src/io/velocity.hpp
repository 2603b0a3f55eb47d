// The velocity of a recording that holds only displacement, and the acceleration of any.
//
// At every sample a cubic is fitted by least squares to the displacement in a window centred on it, and its slope
// taken (Savitzky and Golay 1964, on the true sampling times). The window is symmetric in time, so on uniform samples
// the phase error is exactly zero and the gain at angular frequency w is 1 - (w H)^4/504 for a half window of H
// seconds. Within one half window of the ends, and beside gaps, the same cubic is evaluated off its centre (about four
// times the noise).
//
// The window is the smallest whose velocity noise is 0.1 % of the peak velocity. The displacement noise is the larger
// of quantum/sqrt(12) and a robust estimate from sixth differences. The window never exceeds a twelfth of the dominant
// period (gain error 1e-5), a sixth (1.5e-4) when the noise would otherwise be above 1 % of the peak velocity. The
// period is the short one (tenth percentile) between the recording's own reversals, so sweeps keep their fast end.
// Corners between straight lines (ideal triangle waves, ramps) divide the recording, and no window reaches across them.
// Where a motion turns within a window and more sharply than noise explains, as at corners that are rounded, the window
// is shorter (local_window.hpp); corners drowned in noise are smoothed over one half window on each side.
#pragma once

#include <span>
#include <vector>

namespace hysteron {

// m/s from s and m; time strictly increasing, any spacing. O(N w) with w the samples of a window, at most 1001.
[[nodiscard]] std::vector<double> derive_velocity(std::span<const double> time, std::span<const double> displacement);

// Standard deviation of the noise of derive_velocity, m/s, away from ends, corners and sharp turns; 0 for fewer than 8
// samples.
[[nodiscard]] double derived_velocity_noise(std::span<const double> time, std::span<const double> displacement);

// m/s^2: slopes of local cubics through the velocity. Of a measured velocity the window is the one whose expected error
// is least (Mallows 1973): the noise that passes, and what the slopes differ from those of the shortest window beyond
// what noise explains. A derived velocity keeps the window it was derived with. No phase error; no window reaches
// across corners of the displacement: there the velocity changes within two to three samples.
[[nodiscard]] std::vector<double> derive_acceleration(std::span<const double> time,
                                                      std::span<const double> displacement,
                                                      std::span<const double> velocity, bool measured);

// Standard deviation of the noise of a smooth channel, in its unit: the larger of what each sample differs from the
// quintic through its six neighbours and a quantum over sqrt(12). Time strictly increasing; 0 for fewer than 8 samples.
[[nodiscard]] double channel_noise(std::span<const double> time, std::span<const double> samples);
// The step of a quantised channel, in its unit; 0 when its increments are not multiples of the smallest one.
[[nodiscard]] double channel_quantum(std::span<const double> samples);

}  // namespace hysteron
