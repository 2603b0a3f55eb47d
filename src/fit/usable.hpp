// Recordings that nothing can be identified from.
#pragma once

#include <vector>

#include "core/recording.hpp"

namespace hysteron {

inline constexpr std::size_t fewest_samples = 16;

// What the force of a recording is: that of the damper, or the excitation of a mass on it, which may be none.
enum class ForceOf { damper, excitation };

// Throws InputError where a recording has fewer samples than `fewest_samples` or a damper's force that is the same
// throughout while it moves, and where none of them moves.
void require_usable(const std::vector<Recording>& recordings, ForceOf force = ForceOf::damper);

// Throws InputError where some recordings hold a current and others a voltage or neither: for work in which something
// follows the drive, which would take one for the other, or what was not recorded for zero.
void require_one_drive(const std::vector<Recording>& recordings);

}  // namespace hysteron
