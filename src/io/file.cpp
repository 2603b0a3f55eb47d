#include "io/file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "core/error.hpp"

namespace hysteron {

std::string read_file(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  const std::string name = path.string();
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError(name, 0, "there is no such file, expected a readable file");
  }
  if (std::filesystem::is_directory(status)) throw InputError(name, 0, "is a folder, expected a file");
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(name.c_str(), "rb"), close);
  if (!file) {
    throw InputError(name, 0, std::string("cannot be opened (") + std::system_category().message(errno) + "), expected a readable file");
  }
  std::string bytes;
  if (const auto size = std::filesystem::file_size(path, code); !code) bytes.reserve(size + 1);
  constexpr std::size_t chunk = 1 << 18;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + chunk);
    const std::size_t got = std::fread(bytes.data() + before, 1, chunk, file.get());
    bytes.resize(before + got);
    if (got < chunk) break;
  }
  if (std::ferror(file.get()) != 0) {
    throw InputError(name, 0, std::string("cannot be read (") + std::system_category().message(errno) + "), expected a readable file");
  }
  return bytes;
}

}  // namespace hysteron
