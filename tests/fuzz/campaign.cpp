// campaign.toml. No recording that it names lies outside its folder.
#include <algorithm>
#include <filesystem>

#include "io/campaign_file.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  CampaignFile campaign;
  const std::string text(fuzz::text_of(data, size));
  if (!fuzz::taken([&] { campaign = parse_campaign_file(text, "campaign.toml"); })) return 0;
  for (const CampaignEntry& entry : campaign.entries) {
    const std::filesystem::path path = entry.file;
    fuzz::require(!entry.file.empty() && path.is_relative() && *path.begin() != "..", "recordings lie in the folder");
    fuzz::require(entry.line > 0, "entries have a line");
  }
  for (const auto* orders : {&campaign.by_current, &campaign.by_frequency}) {
    for (const auto& [parameter, order] : *orders) {
      fuzz::require(order >= 0 && order <= highest_order, "orders are those that are accepted");
    }
  }
  return 0;
}
