// Files into memory, whole or in pieces.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace hysteron {

// A file that is read in pieces. A missing, unreadable or non-regular one is an InputError, also while reading.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  [[nodiscard]] std::uintmax_t size() const { return size_; }
  // Appends up to `count` bytes; fewer only at the end of the file.
  void read(std::string& to, std::size_t count);
  void seek(std::uintmax_t position);
  // That the file is still what it was when it was opened.
  void check_unchanged() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uintmax_t size_ = 0;
  std::int64_t changed_s_ = 0;
  std::int64_t changed_ns_ = 0;
};

// The bytes of a file; a missing, unreadable or non-regular one is an InputError.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

// One name for one folder, however it was written: absolute, links followed. The path itself where that cannot be told;
// an empty one is the current folder.
[[nodiscard]] std::filesystem::path absolute_folder(const std::filesystem::path& folder);

}  // namespace hysteron
