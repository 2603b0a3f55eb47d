// Writing results: a file is there whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace hysteron {

// Writes a temporary file beside the target, syncs it and renames it. A failure (read-only folder, full disk) leaves
// the old file and no temporary one, and is a WorkError with the path and the system's reason. A target that is a
// pipe or a device (/dev/stdout) is written directly.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// Makes the folder and its parents; an existing writable folder is fine. Anything else is an InputError, so that a
// wrong --out is told before the work starts.
// Throws InputError, as make_output_folder would, and leaves nothing behind.
void check_output_folder(const std::filesystem::path& path);
void make_output_folder(const std::filesystem::path& path);

// "time [s],force [N]" and one row per sample, in the shortest digits that read back to the same numbers.
[[nodiscard]] std::string csv_of_prediction(std::span<const double> time, std::span<const double> force);

}  // namespace hysteron
