// Whether the range in which the base model's parameters are searched is what it misses.
#pragma once

#include <string>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// A sentence where parameters of the fit sit on an end of their range that is none of what they can be at all, and a
// wider one would take off a twentieth of its error and more, to first order (fit/bounds_met.hpp); else empty.
std::string note_of_bounds(const Workbench& bench, const Fit& base);

}  // namespace hysteron
