// Measured recordings that ship as files: datasets/ID in the source tree, PREFIX/share/hysteron/datasets/ID where the
// program is installed. They are found from the place of the running program, never from a path of the build.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/recording.hpp"

namespace hysteron {

// In the format of sha256sum, one line a recording.
inline constexpr std::string_view shipped_checksums = "SHA256SUMS";

// A folder beside which share/hysteron/datasets is looked for too: a module of another program knows where it stands.
// Not while datasets are being read.
void look_beside(const std::filesystem::path& folder);

// share/hysteron/datasets/ID beside the program or beside its bin folder, or ID in the folder the environment variable
// HYSTERON_DATASETS names. Throws InputError that says where it looked.
[[nodiscard]] std::filesystem::path shipped_folder(std::string_view id);

// The recordings, each compared with its checksum; InputError where one is missing, altered or not listed.
[[nodiscard]] Campaign load_shipped(std::string_view id);

}  // namespace hysteron
