// Recordings as MDF 4 files.
#include "recording_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hysteron::fuzz::read_as("MDF 4", hysteron::fuzz::text_of(data, size));
  return 0;
}
