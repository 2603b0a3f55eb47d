// A signal that repeats itself, recorded over one period.
#pragma once

#include <span>
#include <vector>

namespace hysteron {

// Whether the last sample is the first of the next period already: the values are equal, within a thousandth of their
// range, and the signal goes on more smoothly (by its third differences) where one of the two is left out.
bool last_repeats_first(std::span<const double> values);

// Times of `count` periods one after the other, at the samples of one whose last sample is a step short of the next.
std::vector<double> repeated_times(std::span<const double> time, int count);
// When the last of them ends.
double end_of_periods(std::span<const double> time, int count);

}  // namespace hysteron
