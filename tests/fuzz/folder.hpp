// Where targets put what is read as a file: a folder of this process, in memory where the system has such a place.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hysteron::fuzz {

inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto base = access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
    auto own = base / ("hysteron-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(own);
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return own;
  }();
  return path;
}

}  // namespace hysteron::fuzz
