#include "task/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "check/campaign.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/printable.hpp"
#include "io/format.hpp"
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

// Where a recording of `data` is; nothing where folders were put before its name to tell it from another.
std::filesystem::path path_of(const Recording& recording, const std::vector<std::string>& data) {
  std::error_code code;
  for (const std::string& named : data) {
    std::filesystem::path path(named);
    if (std::filesystem::is_directory(path, code)) {
      std::filesystem::path inside = path / recording.file;
      if (std::filesystem::is_regular_file(inside, code)) return inside;
    } else if (path.filename() == recording.file) {
      return path;
    }
  }
  return {};
}

// What no file can have would change nothing without a word; beside files that have it, one may be without. `files`
// are those that do.
void refuse_of_none(Option option, bool InputFormat::*has, std::string_view what, std::string_view files,
                    const std::vector<Recording>& recordings, const std::vector<std::string>& data) {
  std::string_view first;
  for (const Recording& recording : recordings) {
    const std::filesystem::path path = path_of(recording, data);
    const InputFormat* format = path.empty() ? nullptr : find_format(path);
    if (format == nullptr || format->*has) return;
    if (first.empty()) first = format->name;
  }
  throw OptionError(fmt::format("{}: {} files have no {}, expected no ", recordings.front().file, first, what) +
                    option + fmt::format(", or {}", files));
}

}  // namespace

Loaded load_with_remarks(const std::vector<std::string>& data, ReadOptions options, Required required,
                         const TakenOfCampaign& taken) {
  options.force_required = required == Required::motion_and_force;
  options.displacement_required = required != Required::nothing;
  std::vector<Remark> remarks;
  options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
  Campaign campaign = load_campaign(data, options, taken);
  if (!options.group.empty()) {
    refuse_of_none(Option::group, &InputFormat::groups, "groups", "a TDMS or MDF file or a workbook",
                   campaign.recordings, data);
  }
  if (options.skip > 0) {
    refuse_of_none(Option::skip, &InputFormat::lines, "lines", "a text file or a workbook", campaign.recordings, data);
  }
  if (required == Required::motion_and_force) std::ranges::for_each(campaign.recordings, refuse_excitation_as_force);
  const std::size_t of_each = remarks.size();
  const std::vector<Remark> of_campaign =
      remarks_on(campaign.recordings, required == Required::nothing ? Moving::excitation : Moving::damper);
  remarks.insert(remarks.end(), of_campaign.begin(), of_campaign.end());
  return {std::move(campaign), std::move(remarks), of_each};
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
