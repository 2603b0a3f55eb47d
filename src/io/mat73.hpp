// MATLAB 7.3 files (HDF5), by the HDF5 library in a process of its own.
#pragma once

#include <string_view>
#include <vector>

#include "io/mat_variable.hpp"

namespace hysteron {

// Whether the bytes begin as an HDF5 file does, after a user block or not.
[[nodiscard]] bool is_mat73(std::string_view bytes);

// The variables of the file by name. One that cannot be read is there with its name and `damaged`; a file that cannot
// be read at all is MatDamage. Read twice, with different bytes in fresh memory: every value of the result was read.
[[nodiscard]] std::vector<MatVariable> read_mat73(std::string_view bytes);

}  // namespace hysteron
