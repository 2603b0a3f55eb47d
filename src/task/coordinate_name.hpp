// What a coordinate of a search is called.
#pragma once

#include <string>

#include "fit/layout.hpp"

namespace hysteron {

// "alpha", or for a node of a parameter law "alpha at 0.5 A, 2 Hz".
std::string coordinate_name(const Layout& layout, std::size_t c, DriveKind drive);

}  // namespace hysteron
