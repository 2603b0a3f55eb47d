// Samples of a channel at the times of another.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace hysteron {

// What is assumed of a channel between its samples:
//   smooth    the polynomial through the eight nearest samples (Lagrange), four at the ends and where the spacing
//             changes by more than two, as it does beside gaps, two across such a change. Of a sine with N samples a
//             period the error is at most 0.27 (pi / N)^8 of the amplitude: 3e-5 at 10, 1e-7 at 20. It is as
//             good as band-limited interpolation for a motion that is sampled well, takes samples at any times, and
//             does not reach beyond the ends.
//   straight  lines from sample to sample, for what is switched or changes slowly.
enum class Between { smooth, straight };

// Values at the times `at`, which increase and lie between the first and the last of `time`. Times increase; two at
// least. Where a time is that of a sample, the sample.
[[nodiscard]] std::vector<double> resampled(std::span<const double> time, std::span<const double> values,
                                            std::span<const double> at, Between between);

}  // namespace hysteron
