// A probability as people read it.
#pragma once

#include <string>

namespace hysteron {

// "94 %": whole percent, rounded down, so that none reads as of a higher grade than it has; "over 99 %" below one.
std::string probability_text(double probability);

}  // namespace hysteron
