// Whether the range in which the base model's parameters are searched is what it misses.
#pragma once

#include <string>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Where parameters of the fit sit on ends of their search ranges and that costs error that shows (fit/bounds_met.hpp);
// else empty.
std::string note_of_bounds(const Workbench& bench, const Fit& base);

}  // namespace hysteron
