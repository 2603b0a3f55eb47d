// Where a mass that is held at a deflection, or at rest, is let go: no force acts on it in a free decay, so that one
// which stands still before it moves was held.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/recording.hpp"

namespace hysteron {

// The first sample of the free motion; nothing where the mass moves freely from the first sample on.
std::optional<std::size_t> release_of(std::span<const double> time, std::span<const double> displacement);

// Leaves the samples before this one out. What is derived of the motion is derived again: across the release it is not
// smooth.
void begin_at(Recording& recording, std::size_t first);

}  // namespace hysteron
