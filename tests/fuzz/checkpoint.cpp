// What an interrupted work left beside its results: it is read, or given up, and the work goes on either way.
#include "io/checkpoint.hpp"

#include <filesystem>
#include <fstream>

#include "folder.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::filesystem::path path = fuzz::folder() / "diagnosis.partial";
  std::error_code ignored;
  for (const char* ending : {"-wal", "-shm", "-journal"}) std::filesystem::remove(path.string() + ending, ignored);
  std::ofstream(path, std::ios::binary) << fuzz::text_of(data, size);
  Checkpoint checkpoint(path, "diagnose recordings/");
  checkpoint.keep("a fit", "its bytes");
  if (checkpoint.trouble().empty()) {
    fuzz::require(checkpoint.find("a fit") == "its bytes", "what is kept is found");
  }
  checkpoint.remove();
  fuzz::require(!std::filesystem::exists(path, ignored), "a work that is done leaves no file");
  return 0;
}
