// Whether a channel was measured at a lower rate than the others and interpolated by straight lines to theirs: its
// slope is a staircase, and what lies between its own samples was not measured.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hysteron {

// How many samples the straight pieces of a channel have, where it consists of pieces of one length throughout, several
// to a stroke, that bend from one to the next by changing amounts. The bends may lie on samples or, from four samples a
// piece on, between two of them. Nothing for triangular waves and ramps, which bend at their reversals alone, for held
// rods, for steps of a converter, and where rounding hides the bends.
std::optional<std::size_t> straight_pieces_of(const std::vector<double>& values);

}  // namespace hysteron
