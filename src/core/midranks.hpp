// Ranks of values, ties shared.
#pragma once

#include <vector>

namespace hysteron {

// Ranks from 1 (smallest); equal values share the mean of their ranks. Values within a relative distance `tie` of the
// smallest one of their group count as equal: two optimisers in the same optimum differ by rounding only.
[[nodiscard]] std::vector<double> midranks(const std::vector<double>& values, double tie = 0.0);

}  // namespace hysteron
