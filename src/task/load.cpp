#include "task/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "check/campaign.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/printable.hpp"
#include "io/campaign.hpp"
#include "task/respond.hpp"

namespace hysteron {

namespace {

// What `respond` writes holds the force on the mass under the name of the force, and the damper's own beside it.
void refuse_excitation_as_force(const Recording& recording) {
  const auto own = std::ranges::find_if(
      recording.unused, [](const UnusedColumn& column) { return split_column(column.name).name == damper_force; });
  if (own == recording.unused.end()) return;
  throw OptionError(recording.file + ": its force excites a mass and is not the damper's, expected " + Option::column +
                    " force=\"" + own->name + "\", or an identification from the motion of the mass");
}

}  // namespace

Loaded load_with_remarks(const std::vector<std::string>& data, ReadOptions options, Required required) {
  options.force_required = required == Required::motion_and_force;
  options.displacement_required = required != Required::nothing;
  std::vector<Remark> remarks;
  options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
  Campaign campaign = load_campaign(data, options);
  if (required == Required::motion_and_force) std::ranges::for_each(campaign.recordings, refuse_excitation_as_force);
  const std::vector<Remark> of_campaign =
      remarks_on(campaign.recordings, required == Required::nothing ? Moving::excitation : Moving::damper);
  remarks.insert(remarks.end(), of_campaign.begin(), of_campaign.end());
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
  return valid_utf8(std::filesystem::path(remark.file).filename().string()) + ": " + remark.text.plain();
}

}  // namespace hysteron
