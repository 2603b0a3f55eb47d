#include "io/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <vector>

#include "core/error.hpp"

namespace hysteron {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int reason) {
  throw WorkError(path.string() + ": cannot be written: " + std::system_category().message(reason));
}

// 0, or the errno of the first failure.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_directly(const std::filesystem::path& path, std::string_view bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, errno);
  const int reason = write_all(descriptor, bytes);
  ::close(descriptor);
  if (reason != 0) fail(path, reason);
}

void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  if (path.empty()) throw InputError("the output file has no name, expected a file for the results");
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (std::filesystem::is_directory(status)) fail(path, EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return write_directly(path, bytes);

  // Through a symbolic link the file it points to is replaced, not the link.
  auto target = path;
  if (std::filesystem::is_symlink(path, code)) {
    const auto resolved = std::filesystem::weakly_canonical(path, code);
    if (!code) target = resolved;
  }
  auto temporary = target;
  temporary += ".tmp-" + std::to_string(::getpid());
  ::unlink(temporary.c_str());  // of a killed process that had the same number
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path, errno);
  int reason = write_all(descriptor, bytes);
  if (reason == 0 && ::fsync(descriptor) != 0) reason = errno;
  if (::close(descriptor) != 0 && reason == 0) reason = errno;
  if (reason == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) reason = errno;
  if (reason != 0) {
    ::unlink(temporary.c_str());
    fail(path, reason);
  }
  // The rename itself survives a power cut only once the folder is synced; not every file system allows it.
  const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  if (const int of_folder = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); of_folder >= 0) {
    ::fsync(of_folder);
    ::close(of_folder);
  }
}

void make_output_folder(const std::filesystem::path& path) {
  if (path.empty()) throw InputError("the output folder has no name, expected a folder for the results");
  const std::string name = path.string();
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) {
    throw InputError(name, 0, "exists and is not a folder, expected a folder for the results");
  }
  std::filesystem::create_directories(path, code);
  if (code || !std::filesystem::is_directory(path)) {
    throw InputError(name, 0, "the folder cannot be made (" + code.message() + "), expected a writable place");
  }
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw InputError(name, 0,
                     std::string("the folder cannot be written to (") + std::system_category().message(errno) +
                         "), expected a writable place");
  }
}

void check_output_folder(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> missing;
  std::error_code code;
  for (auto folder = std::filesystem::absolute(path, code);
       !folder.empty() && folder != folder.root_path() && !std::filesystem::exists(folder, code);
       folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  // Made and taken away again: permissions alone do not tell.
  const auto take_away = [&] {
    for (const auto& folder : missing) {
      std::filesystem::remove(folder, code);
    }
  };
  try {
    make_output_folder(path);
  } catch (...) {
    take_away();
    throw;
  }
  take_away();
}

std::string csv_of_prediction(std::span<const double> time, std::span<const double> force) {
  assert(time.size() == force.size());
  std::string text = "time [s],force [N]\n";
  text.reserve(text.size() + 32 * time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    append(text, time[i]);
    text += ',';
    append(text, force[i]);
    text += '\n';
  }
  return text;
}

}  // namespace hysteron
