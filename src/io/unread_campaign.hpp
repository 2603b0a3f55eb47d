// The campaign.toml that says something of recordings and is not read, since they are given without its folder.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "io/campaign.hpp"

namespace hysteron {

// By its own name, or by that of a folder that has no campaign.toml.
enum class GivenBy { name, folder };

struct GivenRecording {
  std::filesystem::path path;
  GivenBy by;
};

// Remarks on the campaign.toml beside a recording given by name, and on those one and two folders above a recording
// that list it, where anything would be taken of them. `read` are absolute folders that are given themselves.
void tell_unread_campaigns(const std::vector<GivenRecording>& recordings, const std::set<std::filesystem::path>& read,
                           const ReadOptions& options, const TakenOfCampaign& taken);

}  // namespace hysteron
