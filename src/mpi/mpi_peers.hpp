// MPI, where the program is built with it: who started this process, and messages to the others.
#pragma once

#include <memory>
#include <optional>

#include "study/together.hpp"

namespace hysteron {

// Which process of how many, where mpirun or the like started this one: from the environment, so that an ordinary call
// need not start MPI.
struct Launched {
  int rank = 0;
  int size = 1;
};
[[nodiscard]] std::optional<Launched> launched();

[[nodiscard]] bool built_with_mpi();

// Starts MPI; its destructor ends it. Throws WorkError where that fails, or where the program is built without.
[[nodiscard]] std::unique_ptr<Peers> start_mpi();

}  // namespace hysteron
