// Recordings as the command line names them: files and folders, with an optional campaign.toml.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// One file of any of the formats (io/format.hpp). Recording::file is the file's name without its folders.
[[nodiscard]] Recording load_recording(const std::filesystem::path& path, const ReadOptions& options = {});

// What is taken of a campaign.toml, beside its recordings with their starts and numbers.
struct TakenOfCampaign {
  bool model = true;
  bool laws = true;
  std::set<std::string> other_laws = {};  // not those in these, "current", "frequency" or a condition
  bool roles = true;
  bool given_later = false;  // model and laws may still be given to what works with the recordings

  [[nodiscard]] bool laws_in(const std::string& what) const { return laws && !other_laws.contains(what); }
};

// Of what works with models that are identified already.
inline const TakenOfCampaign recordings_alone{.model = false, .laws = false, .roles = false};

// Every argument is a recording or a folder: its recordings in bytewise order of name (not those of its
// subfolders), or those its campaign.toml lists, with their roles. Recording::file is the name relative to the folder;
// where two are the same, the names of parent folders go before it. Campaign files of several folders are merged and
// must not contradict each other. A campaign.toml that says something of recordings which are given without its folder
// is not read, which is remarked (io/unread_campaign.hpp). Everything wrong is an InputError.
[[nodiscard]] Campaign load_campaign(const std::vector<std::string>& data, const ReadOptions& options = {},
                                     const TakenOfCampaign& taken = {});

}  // namespace hysteron
