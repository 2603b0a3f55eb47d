// The store of a study as a file: what SQLite lets through, every row of it read.
#include "study/store.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "target.hpp"
#include "task/study.hpp"

namespace {

// A folder of this process, in memory where the system has such a place.
const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto base = access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
    auto own = base / ("hysteron-fuzz-store-" + std::to_string(getpid()));
    std::filesystem::create_directories(own);
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return own;
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  std::error_code ignored;
  for (const char* left : {"store.sqlite-wal", "store.sqlite-shm", "store.sqlite-journal"}) {
    std::filesystem::remove(folder() / left, ignored);
  }
  std::ofstream(folder() / "store.sqlite", std::ios::binary) << fuzz::text_of(data, size);
  // A failure of SQLite itself is one of the work.
  fuzz::taken<std::runtime_error>([&] {
    try {
      const Store store = Store::open(folder(), Store::Mode::read);
      static_cast<void>(store.problems());
      static_cast<void>(view_of(store, store.records(), "study"));
    } catch (const InputError& error) {
      throw std::runtime_error(error.what());
    } catch (const WorkError& error) {
      throw std::runtime_error(error.what());
    }
  });
  return 0;
}
