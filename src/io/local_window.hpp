// Slopes by windows as long as the samples allow at each place (Lepski 1991; Katkovnik 1999, doi 10.1109/78.782200).
//
// A long window passes little noise, and rounds what happens within it: where a motion turns sharply, as a triangle
// wave behind a servo valve does, its slope is wrong by a good part of the bend. So a shorter window is taken wherever
// its slope differs from the longer one's by more than noise explains, the noise nearby if that is more.
#pragma once

#include <span>

namespace hysteron {

// As local_cubic_slopes (local_cubic.hpp), of windows of `side` samples on each side and, where asked for, of a half, a
// quarter and so on. `noise` of the samples, standard deviation. O(n side).
void local_window_slopes(std::span<const double> time, std::span<const double> displacement, double side,
                         double median_step, double noise, std::span<double> velocity);

}  // namespace hysteron
