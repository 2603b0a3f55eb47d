// Whether a recording has enough samples a period of its motion to tell a velocity.
#pragma once

#include <optional>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// A remark where its main frequency has so few samples a period that derived velocities and reversals are guessed.
std::optional<Remark> remark_on_sampling(const Recording& recording);

}  // namespace hysteron
