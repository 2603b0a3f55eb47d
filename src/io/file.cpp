#include "io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron {

namespace {

// Of a file that is meant to be read whole. Far above any recording, and below what eats a machine's memory.
constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30U;

[[noreturn]] void fail(const std::string& name, const std::string& what, int reason) {
  throw InputError(name, 0, what + " (" + std::system_category().message(reason) + "), expected a readable file");
}

// The file in the same folder whose name is nearest, to be offered.
std::string nearest_to(const std::filesystem::path& path) {
  if (!path.has_filename()) return {};
  constexpr std::size_t most = 1000;
  std::vector<std::string> names;
  std::error_code code;
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (std::filesystem::directory_iterator at(folder, code), end; !code && at != end && names.size() < most;
       at.increment(code)) {
    // Names begin alike; others are near by their ending only.
    const std::string name = at->path().filename().string();
    if (name.front() == path.filename().string().front()) names.push_back(name);
  }
  std::ranges::sort(names);
  return suggestion(path.filename().string(), names);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  // Without waiting: opening a pipe would last until somebody writes.
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) {
    throw InputError(name, 0, "there is no such file" + nearest_to(path) + ", expected a readable file");
  }
  if (descriptor < 0) fail(name, "cannot be opened", errno);
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(::fdopen(descriptor, "rb"), close);
  if (!file) fail(name, "cannot be opened", errno);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(name, "cannot be read", errno);
  if (S_ISDIR(status.st_mode)) throw InputError(name, 0, "is a folder, expected a file");
  if (!S_ISREG(status.st_mode)) throw InputError(name, 0, "is a pipe or a device, expected a regular file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > largest_file) {
    throw InputError(
        name, 0,
        "has " + std::to_string(size >> 20U) + " MiB, expected at most " + std::to_string(largest_file >> 20U));
  }
  std::string bytes;
  bytes.reserve(size + 1);
  constexpr std::size_t chunk = 1 << 18;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + chunk);
    const std::size_t got = std::fread(bytes.data() + before, 1, chunk, file.get());
    bytes.resize(before + got);
    if (got < chunk) break;
    if (bytes.size() > largest_file) throw InputError(name, 0, "grows while it is read, expected a complete file");
  }
  if (std::ferror(file.get()) != 0) fail(name, "cannot be read", errno);
  return bytes;
}

}  // namespace hysteron
