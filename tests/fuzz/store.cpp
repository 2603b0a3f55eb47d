// The store of a study as a file: what SQLite lets through, every row of it read.
#include "study/store.hpp"

#include <filesystem>
#include <fstream>

#include "folder.hpp"
#include "target.hpp"
#include "task/study.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  std::error_code ignored;
  for (const char* left : {"store.sqlite-wal", "store.sqlite-shm", "store.sqlite-journal"}) {
    std::filesystem::remove(fuzz::folder() / left, ignored);
  }
  std::ofstream(fuzz::folder() / "store.sqlite", std::ios::binary) << fuzz::text_of(data, size);
  // A failure of SQLite itself is one of the work.
  fuzz::taken<std::runtime_error>([&] {
    try {
      const Store store = Store::open(fuzz::folder(), Store::Mode::read);
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
