// Motions too long for the intervals between all their samples to be kept: they are prepared for the samples that a
// march is about to pass, which takes a fifth of the memory.
#pragma once

#include "simulate/motion.hpp"

namespace hysteron {

// As make_motion, without intervals and jerk.
Motion make_lean_motion(std::span<const double> time, std::span<const double> displacement,
                        std::span<const double> velocity, std::span<const double> drive, double tolerance = 1e-4,
                        std::span<const double> acceleration = {});
[[nodiscard]] inline bool is_lean(const Motion& motion) { return motion.intervals.empty() && motion.time.size() > 1; }

// Samples [first, last) of a lean motion, with the intervals that make_motion gives them.
void prepare(const Motion& lean, std::size_t first, std::size_t last, Motion& piece);

// How a motion is marched: all but its samples.
void copy_settings(const Motion& from, Motion& to);

}  // namespace hysteron
