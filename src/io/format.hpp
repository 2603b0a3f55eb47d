// A kind of file that recordings come in: one file of src/io/formats each, which defines format_NAME. A file is of the
// kind that its first bytes tell; text, which begins with anything, is told by its ending.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Whether files of an ending are recordings where a folder is named: all of them, only where no others are in it, or
// none, so that they must be named themselves.
enum class InFolders { all, without_others, none };

struct Ending {
  std::string_view text;  // lower case, with its dot
  InFolders in_folders = InFolders::all;
};

struct InputFormat {
  std::string_view name;  // in messages: "TDMS"
  std::span<const Ending> endings;
  // Whether bytes at the head of a file (bytes_of_head of them, or all of a shorter one) are of this kind; null for
  // text.
  bool (*begins)(std::string_view head);
  // The recording in SI; `file` opens every message. Recording::file and sha256 are left empty. Everything wrong is an
  // InputError.
  Recording (*parse)(std::string_view bytes, const std::string& file, const ReadOptions& options);
  // The same of a file that is not read into memory whole, with its sha256; null where it is.
  Recording (*read)(const std::filesystem::path& path, const ReadOptions& options) = nullptr;
  // How many samples the file may hold, for sharing --keep-samples out before it is read.
  std::size_t (*samples)(const std::filesystem::path& path);
  // Whether a file has groups of channels, or sheets, of which one is read (--group).
  bool groups = false;
  // Whether it is made of lines, or rows of a sheet, of which the first may be left out (--skip).
  bool lines = false;
};

inline constexpr std::size_t bytes_of_head = 1024;

// In the order of their names.
[[nodiscard]] std::span<const InputFormat* const> formats();

// The format of a file; nullptr where neither its bytes nor its ending are of any. Throws InputError where the file
// cannot be read.
[[nodiscard]] const InputFormat* find_format(const std::filesystem::path& path);

// Whether a file is a recording where its folder is named, by its name alone: hidden files are none, nor are those that
// office programs keep beside an open file (~$NAME).
[[nodiscard]] InFolders in_folders(const std::filesystem::path& path);

// Of binary formats: two channels of numbers of 8 bytes.
[[nodiscard]] std::size_t samples_by_size(const std::filesystem::path& path);

// ".csv, .txt or .mat": of all formats.
[[nodiscard]] std::string list_of_endings();

}  // namespace hysteron
