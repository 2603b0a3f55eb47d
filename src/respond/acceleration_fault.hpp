// A recorded acceleration against the displacement of the same motion: the equation of motion needs that of the mass
// relative to its base.
#pragma once

#include <optional>

#include "core/recording.hpp"

namespace hysteron {

struct AccelerationFault {
  enum class Kind {
    reversed,  // of the other sign
    factor,    // of another size
    offset,    // off by a constant
    absolute,  // of the mass, not relative to the base that is recorded
    of_base,   // of that base
    foreign    // of something else
  };
  Kind kind;
  double size;  // times what the displacement tells; of an offset m/s^2, of what is foreign the correlation
};

// Nothing where the acceleration is that of the displacement, none was recorded, or the displacement does not tell.
std::optional<AccelerationFault> acceleration_fault_of(const Recording& recording);

}  // namespace hysteron
