// Recordings as the command line names them: files and folders, with an optional campaign.toml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// One file of any of the formats (io/format.hpp). Recording::file is the file's name without its folders.
[[nodiscard]] Recording load_recording(const std::filesystem::path& path, const ReadOptions& options = {});

// Every argument is a recording or a folder: its recordings in bytewise order of name (not those of its
// subfolders), or those its campaign.toml lists, with their roles. Recording::file is the name relative to the folder;
// where two are the same, the names of parent folders go before it. Campaign files of several folders are merged and
// must not contradict each other. Everything wrong is an InputError.
[[nodiscard]] Campaign load_campaign(const std::vector<std::string>& data, const ReadOptions& options = {});

}  // namespace hysteron
