// Where the displacement of a recording does not tell the rod from one that is held still.
//
// What is left of a held rod's velocity is noise, and noise is motion to a damper law: hysteresis loses its force to
// and fro, in proportion to the distance gone. A rod held for half a second under 0.3 mm/s of noise has lost a tenth of
// the force that a damper with a yield displacement of 1 mm holds. Where the rod is held, its velocity is zero.
//
// Blocks of 16 samples in which a parabola finds neither slope nor bend at four standard errors of the noise of the
// channel make up a stretch, three of them and more, if their means scatter by no more than that noise does
// (chi-squared within four of its standard deviations). Creeping looks like this, too, stretch after stretch: of two
// neighbours with different means neither is held unless the rod moves twenty standard deviations of the noise in
// between.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Samples [first, end) in which the rod is held.
struct Still {
  std::size_t first;
  std::size_t end;
};

// In order of time; none without noise, in fewer than 48 samples, or where the whole displacement is within twenty
// standard deviations of the noise: there is no motion to tell it from then. Times strictly increasing.
[[nodiscard]] std::vector<Still> still_stretches(std::span<const double> time, std::span<const double> displacement);

// Sets velocity and acceleration to zero where the rod is held; of a measured velocity only what is within four
// standard deviations of its noise, so that a late channel keeps its tail.
void hold_still(Recording& recording);

}  // namespace hysteron
