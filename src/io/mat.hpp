// Recordings from MATLAB files, level 5 and 7.3 (HDF5).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// A recording in SI. Channels are numeric vectors named as CSV columns are; an optional struct `units` holds their
// units as text (none: SI). A matrix is read by mapping channels to its columns: "3 [kN]" when it is the only matrix,
// else "NAME:3 [kN]". `file` opens every message. Recording::file is left empty, and by parse_mat
// sha256. Everything wrong is an InputError.
[[nodiscard]] Recording parse_mat(std::string_view bytes, const std::string& file, const ReadOptions& options = {});
[[nodiscard]] Recording read_mat(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace hysteron
