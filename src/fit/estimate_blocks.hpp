// How far estimate() (identify.hpp) is, for those who show it.
#pragma once

#include <cstddef>

#include "fit/objective.hpp"

namespace hysteron {

// Blocks of samples that it passes: at each of them the objective asks whether it is stopped.
std::size_t blocks_of_estimate(const Objective& objective);

}  // namespace hysteron
