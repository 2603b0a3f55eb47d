// Recordings as RPC III files.
#include "recording_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hysteron::fuzz::read_as("RPC III", hysteron::fuzz::text_of(data, size));
  return 0;
}
