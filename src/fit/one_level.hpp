// What laws lack where the recordings hold one value of what they follow.
#pragma once

#include <string>

#include "fit/layout.hpp"

namespace hysteron {

// Of laws in "current", the drive, "frequency" or a condition of the scale: "the recordings hold only one frequency,
// expected at least two"; empty where there are several values.
std::string lack_of_levels(const DataScale& scale, const std::string& what);

}  // namespace hysteron
