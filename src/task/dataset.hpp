#pragma once

#include <string>

#include "core/recording.hpp"

namespace hysteron {

// The file that `hysteron generate` writes of a recording of a simulated dataset.
std::string csv_of_simulated(const Recording& recording);

}  // namespace hysteron
