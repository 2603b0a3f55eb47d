// Slopes of cubics fitted by least squares to the samples in windows centred on each (Savitzky and Golay 1964, on the
// true sampling times).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

inline constexpr std::size_t fewest_on_a_side = 2;  // five points: a cubic with one to spare

// Standard deviations of its noise that of a million samples none reaches.
inline constexpr double beyond_noise = 5.0;

// Slopes of a stretch without corners, per second; `side` samples on each side of the window, of `median_step` s each.
// `noise` of the samples, standard deviation: near an end it bounds the window and the degree.
void local_cubic_slopes(std::span<const double> time, std::span<const double> displacement, double side,
                        double median_step, double noise, std::span<double> velocity);

// Weights of the slope of a cubic over 2 side + 1 samples of spacing 1.
[[nodiscard]] std::vector<double> uniform_weights(std::size_t side);

}  // namespace hysteron
