#include "mpi/mpi_peers.hpp"

#include "core/error.hpp"

namespace hysteron {

bool built_with_mpi() { return false; }

std::unique_ptr<Peers> start_mpi() {
  throw WorkError(
      "started by mpirun, but this program is built without MPI: configure with -DHYSTERON_MPI=ON, or run shards");
}

}  // namespace hysteron
