// MATLAB level 5 files (save -v6 and -v7). Source: MathWorks, MAT-File Format (R2015b), chapter 1.
#pragma once

#include <string_view>
#include <vector>

#include "io/mat_variable.hpp"

namespace hysteron {

// The variables of the file in their order. No size of the file is believed before it is held against the bytes that
// are there; anything that does not add up, in any variable, is MatDamage.
[[nodiscard]] std::vector<MatVariable> read_mat5(std::string_view bytes);

}  // namespace hysteron
