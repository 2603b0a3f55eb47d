// The pagmo part of the comparison, a loadable module of its own: Debian's libpagmo is built without AVX, and Eigen's
// memory layout differs between instruction sets, so no Eigen code may be shared with the rest of the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace hysteron::peers {

using ScalarObjective = std::function<double(const double*)>;  // NRMSE at a point of the unit box

// Runs algorithm "cmaes", "pso" or "de" once, until it stops by itself, has used the budget, or the objective throws.
using RunPagmo = void (*)(const char* algorithm, std::size_t dimension, std::size_t budget, std::uint32_t seed,
                          const ScalarObjective& objective);
inline constexpr const char* run_pagmo_symbol = "hysteron_run_pagmo";

}  // namespace hysteron::peers
