#include "io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
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

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
  // Without waiting: opening a pipe would last until somebody writes.
  const int descriptor = ::open(name_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) {
    throw InputError(name_, 0, "there is no such file" + nearest_to(path) + ", expected a readable file");
  }
  if (descriptor < 0) fail(name_, "cannot be opened", errno);
  file_.reset(::fdopen(descriptor, "rb"));
  if (!file_) fail(name_, "cannot be opened", errno);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(name_, "cannot be read", errno);
  if (S_ISDIR(status.st_mode)) throw InputError(name_, 0, "is a folder, expected a file");
  if (!S_ISREG(status.st_mode)) throw InputError(name_, 0, "is a pipe or a device, expected a regular file");
  size_ = static_cast<std::uintmax_t>(status.st_size);
  changed_s_ = status.st_mtim.tv_sec;
  changed_ns_ = status.st_mtim.tv_nsec;
}

void InputFile::read(std::string& to, std::size_t count) {
  const std::size_t before = to.size();
  to.resize(before + count);
  const std::size_t got = std::fread(to.data() + before, 1, count, file_.get());
  to.resize(before + got);
  if (std::ferror(file_.get()) != 0) fail(name_, "cannot be read", errno);
}

void InputFile::seek(std::uintmax_t position) {
  if (::fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) != 0) fail(name_, "cannot be read", errno);
}

void InputFile::check_unchanged() const {
  struct stat status {};
  if (::fstat(::fileno(file_.get()), &status) != 0) fail(name_, "cannot be read", errno);
  if (static_cast<std::uintmax_t>(status.st_size) != size_ || status.st_mtim.tv_sec != changed_s_ ||
      status.st_mtim.tv_nsec != changed_ns_) {
    throw InputError(name_, 0, "changes while it is read, expected a complete file");
  }
}

std::string read_file(const std::filesystem::path& path) {
  InputFile file(path);
  if (file.size() > largest_file) {
    throw InputError(
        path.string(), 0,
        "has " + std::to_string(file.size() >> 20U) + " MiB, expected at most " + std::to_string(largest_file >> 20U));
  }
  std::string bytes;
  bytes.reserve(file.size() + 1);
  constexpr std::size_t chunk = 1 << 18;
  for (;;) {
    const std::size_t before = bytes.size();
    file.read(bytes, chunk);
    if (bytes.size() < before + chunk) break;
    if (bytes.size() > largest_file) {
      throw InputError(path.string(), 0, "grows while it is read, expected a complete file");
    }
  }
  return bytes;
}

std::filesystem::path absolute_folder(const std::filesystem::path& folder) {
  std::error_code code;
  auto result = std::filesystem::weakly_canonical(folder.empty() ? std::filesystem::path(".") : folder, code);
  return code ? folder : result;
}

}  // namespace hysteron
