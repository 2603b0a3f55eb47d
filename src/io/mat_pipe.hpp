// Variables of a MAT file as they go through the pipe from the process that reads HDF5: numbers as they lie in memory,
// text and lists behind their length.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mat_variable.hpp"

namespace hysteron {

void append_piped(std::string& bytes, const MatVariable& variable);

// Believes nothing: the other process may have gone wrong in any way. What is not the whole of some variables is
// MatDamage.
[[nodiscard]] std::vector<MatVariable> read_piped(std::string_view bytes);

}  // namespace hysteron
