// Whole files into memory.
#pragma once

#include <filesystem>
#include <string>

namespace hysteron {

// The bytes of a file; a missing, unreadable or non-regular one is an InputError.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace hysteron
