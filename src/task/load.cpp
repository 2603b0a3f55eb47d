#include "task/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "check/campaign.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/printable.hpp"
#include "io/campaign.hpp"
#include "io/text.hpp"

namespace hysteron {

namespace {

// What `respond` writes holds the force on the mass under the name of the force, and the damper's own beside it.
void refuse_excitation_as_force(const Recording& recording) {
  const auto own = std::ranges::find_if(
      recording.unused, [](const UnusedColumn& column) { return split_column(column.name).name == "damper force"; });
  if (own == recording.unused.end()) return;
  throw OptionError(recording.file + ": its force excites a mass and is not the damper's, expected " + Option::column +
                    " force=\"" + own->name + "\", or an identification from the motion of the mass");
}

constexpr std::string_view clock_condition = "clock";

bool has_start(const Recording& recording) { return recording.started.has_value(); }

bool is_clock(const UnusedColumn& column) { return lower_case(split_column(column.name).name) == clock_condition; }

// Whether a file, campaign.toml or the command line gives a clock of its own: beside what the starts tell.
bool has_clock_of_its_own(const std::vector<Recording>& recordings) {
  const std::ptrdiff_t told = recordings.size() > 1 && std::ranges::all_of(recordings, has_start) ? 1 : 0;
  return std::ranges::any_of(
      recordings, [&](const Recording& recording) { return std::ranges::count_if(recording.unused, is_clock) > told; });
}

// The start of every recording, s since that of the first, as a condition that laws follow.
void follow_clock(std::vector<Recording>& recordings) {
  const auto without = std::ranges::find_if_not(recordings, has_start);
  if (without != recordings.end()) {
    throw InputError(without->file +
                     ": says no start, and parameters follow the clock; expected a comment `# start: "
                     "2026-11-24T14:50:58` above its rows, or its start in campaign.toml");
  }
  const double first = *std::ranges::min(recordings, {}, [](const Recording& one) { return *one.started; }).started;
  for (Recording& recording : recordings) {
    std::erase_if(recording.unused, is_clock);
    const auto at = std::ranges::lower_bound(recording.conditions, clock_condition, {}, &ConditionChannel::name);
    recording.conditions.insert(at, {std::string(clock_condition), "s", {*recording.started - first}});
  }
}

// Recordings whose start is told by none of their own, and where it is asked for as a condition.
Campaign load_with_clock(const std::vector<std::string>& data, const ReadOptions& options) {
  ReadOptions without = options;
  if (std::erase(without.conditions, clock_condition) == 0 || options.numbers.contains(std::string(clock_condition))) {
    Campaign campaign = load_campaign(data, options);
    // A number for the clock is meant, wherever the recordings' starts lie.
    if (options.numbers.contains(std::string(clock_condition))) {
      for (Recording& recording : campaign.recordings) recording.started.reset();
    }
    return campaign;
  }
  without.remark = {};  // a second reading would say everything twice
  Campaign campaign = load_campaign(data, without);
  if (has_clock_of_its_own(campaign.recordings) || std::ranges::none_of(campaign.recordings, has_start)) {
    return load_campaign(data, options);
  }
  without.remark = options.remark;
  campaign = load_campaign(data, without);
  follow_clock(campaign.recordings);
  return campaign;
}

// One start that is not told takes the clock from all.
void remark_on_starts(const std::vector<Recording>& recordings, std::vector<Remark>& remarks) {
  if (std::ranges::none_of(recordings, has_start)) return;
  for (const Recording& recording : recordings) {
    if (recording.started) continue;
    const std::string text = "no start that can be read, while other recordings have one: the clock is left out of all";
    remarks.push_back({recording.file, Remark::Kind::dialect, text, text});
  }
}

}  // namespace

Loaded load_with_remarks(const std::vector<std::string>& data, ReadOptions options, Required required) {
  options.force_required = required == Required::motion_and_force;
  options.displacement_required = required != Required::nothing;
  std::vector<Remark> remarks;
  options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
  Campaign campaign = load_with_clock(data, options);
  remark_on_starts(campaign.recordings, remarks);
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
