// A file that goes on behind its recording with the last values.
#pragma once

#include <cstddef>
#include <optional>

#include "core/recording.hpp"

namespace hysteron {

// First or last samples in which displacement and force have exactly one value each, while their noise elsewhere lets
// them have it in a few samples running at most.
struct HeldEnd {
  bool first = false;     // at the start
  std::size_t count = 0;  // of samples
};
// The longer one of both ends.
std::optional<HeldEnd> held_end_of(const Recording& recording);

}  // namespace hysteron
