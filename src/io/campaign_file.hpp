// The file campaign.toml, schema "hysteron.campaign/1".
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Of a parameter law in drive or frequency; beyond it a polynomial through measured levels means nothing.
inline constexpr int highest_order = 5;

struct CampaignEntry {
  std::string file;  // relative to the folder, forward slashes
  Role role = Role::unassigned;
  int role_line = 0;
  std::optional<double> start;  // s since 1970
  bool start_has_zone = false;  // in UTC, else by the clock of the place
  int start_line = 0;
  std::map<std::string, ConditionNumber> numbers;  // of the whole recording, by name
  int line = 0;                                    // of the entry, for messages
};

struct CampaignFile {
  std::string model;  // may be empty
  LawOrders by_current;
  LawOrders by_frequency;
  std::map<std::string, LawOrders> by;                               // in conditions, by their names
  std::map<std::pair<std::string, std::string>, int> lines_of_laws;  // as in Campaign
  std::vector<CampaignEntry> entries;                                // empty: all recordings of the folder
};

// Unknown keys, wrong types and values are InputErrors at file:line. Whether the files exist is not looked at.
[[nodiscard]] CampaignFile read_campaign_file(const std::filesystem::path& path);
// The same of the text of a file; `path` opens the messages.
[[nodiscard]] CampaignFile parse_campaign_file(const std::string& text, const std::filesystem::path& path);

}  // namespace hysteron
