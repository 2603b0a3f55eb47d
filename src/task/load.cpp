#include "task/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/printable.hpp"
#include "io/campaign.hpp"
#include "task/beside_others.hpp"

namespace hysteron {
namespace {

// Recordings whose file is that of an earlier one, by name.
std::vector<std::pair<std::string, std::string>> copies_in(const Campaign& campaign) {
  std::map<std::string, std::string> first;
  std::vector<std::pair<std::string, std::string>> copies;
  for (const Recording& recording : campaign.recordings) {
    const auto [known, fresh] = first.emplace(recording.sha256, recording.file);
    if (!fresh && !recording.sha256.empty()) copies.emplace_back(recording.file, known->second);
  }
  return copies;
}

}  // namespace

Loaded load_with_remarks(const std::vector<std::string>& data, ReadOptions options, Required required) {
  options.force_required = required == Required::motion_and_force;
  options.displacement_required = required != Required::nothing;
  std::vector<Remark> remarks;
  options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
  Campaign campaign = load_campaign(data, options);
  for (const auto& [copy, original] : copies_in(campaign)) {
    remarks.push_back({copy, Remark::Kind::implausible, "copy",
                       "holds the same bytes as " + original + ", so that neither is held out from the other"});
  }
  const std::vector<Remark> units = remarks_beside_others(campaign.recordings);
  remarks.insert(remarks.end(), units.begin(), units.end());
  return {std::move(campaign), std::move(remarks)};
}

std::vector<Remark> once_each(const std::vector<Remark>& remarks) {
  std::vector<Remark> result;
  for (const Remark& remark : remarks) {
    if (std::ranges::find(result, remark.key, &Remark::key) != result.end()) continue;
    result.push_back(remark);
    const auto alike = std::ranges::count(remarks, remark.key, &Remark::key) - 1;
    if (alike > 0) result.back().text += fmt::format(" ({} more recording{} alike)", alike, alike > 1 ? "s" : "");
  }
  return result;
}

std::string warning_of(const Remark& remark) {
  return valid_utf8(std::filesystem::path(remark.file).filename().string()) + ": " + remark.text;
}

}  // namespace hysteron
