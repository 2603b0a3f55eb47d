// A hash of the numbers of a recording: of a file that was saved again with other line ends or in another format it is
// the same, where that of its bytes is another one.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Of channels, in this order.
[[nodiscard]] std::string sha256_of_channels(std::initializer_list<const std::vector<double>*> channels);

// Of what was measured, in SI, not of what was derived from it.
[[nodiscard]] std::string sha256_of_values(const Recording& recording);

}  // namespace hysteron
