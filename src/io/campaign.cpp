#include "io/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/earlier_work.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/number_text.hpp"
#include "core/printable.hpp"
#include "core/suggest.hpp"
#include "io/block_means.hpp"
#include "io/campaign_file.hpp"
#include "io/clock_time.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/format.hpp"
#include "io/plausible.hpp"
#include "io/sha256.hpp"
#include "io/text.hpp"
#include "io/unread_campaign.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

// A recording to load: where it is and how it is named in results.
struct Item {
  fs::path path;
  std::string name;  // relative to `base`
  fs::path base;     // absolute folder, for telling equal names apart
  Role role = Role::unassigned;
  LineOfFile role_at = {};  // of campaign.toml
  std::map<std::string, ConditionNumber> numbers = {};
  // Of campaign.toml, with its line.
  std::optional<double> start = {};
  bool start_has_zone = false;
  int start_line = 0;
};

std::string extension_of(const fs::path& path) { return lower_case(path.extension().string()); }

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

bool is_recording(const fs::path& path) {
  const std::string ending = extension_of(path);
  for (const InputFormat* format : formats()) {
    if (std::ranges::find(format->endings, ending, &Ending::text) != format->endings.end()) return true;
  }
  return false;
}

// The recordings of a folder in bytewise order of name.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::vector<std::string> if_alone;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    const std::string name = at->path().filename().string();
    const InFolders taken = in_folders(at->path());
    if (taken == InFolders::none || is_folder(at->path())) continue;
    (taken == InFolders::all ? names : if_alone).push_back(name);
  }
  if (code)
    throw InputError(folder.string(), 0, "the folder cannot be read (" + code.message() + "), expected recordings");
  // Beside recordings, a workbook holds what somebody wrote about them.
  if (names.empty()) names = std::move(if_alone);
  std::ranges::sort(names);
  return names;
}

void merge_orders(std::map<std::string, int>& into, const std::map<std::string, int>& from, const std::string& file,
                  std::string_view table) {
  for (const auto& [parameter, order] : from) {
    const auto [at, added] = into.emplace(parameter, order);
    if (!added && at->second != order) {
      throw InputError(file, 0,
                       "order " + std::to_string(order) + " of " + in_quotes(parameter) + " in [" + std::string(table) +
                           "] contradicts order " + std::to_string(at->second) +
                           " of another folder, expected the same");
    }
  }
}

void merge(Campaign& campaign, const CampaignFile& declared, const TakenOfCampaign& taken, const std::string& file) {
  if (taken.model && !declared.model.empty()) {
    if (!campaign.model.empty() && campaign.model != declared.model) {
      throw InputError(file, 0,
                       "model " + in_quotes(declared.model) + " contradicts " + in_quotes(campaign.model) +
                           " of another folder, expected the same");
    }
    campaign.model = declared.model;
  }
  if (taken.laws_in("current")) merge_orders(campaign.by_current, declared.by_current, file, "by_current");
  if (taken.laws_in("frequency")) merge_orders(campaign.by_frequency, declared.by_frequency, file, "by_frequency");
  for (const auto& [condition, orders] : declared.by) {
    if (taken.laws_in(condition)) merge_orders(campaign.by[condition], orders, file, "by." + condition);
  }
  for (const auto& [law, line] : declared.lines_of_laws) {
    if (taken.laws_in(law.first)) campaign.lines_of_laws.try_emplace(law, LineOfFile{file, line});
  }
}

// The file beside one that is not there whose name is nearest, to be offered.
std::string nearest_beside(const fs::path& folder, const std::string& file) {
  constexpr std::size_t most = 1000;
  const fs::path inside = fs::path(file).parent_path();
  const std::string name = fs::path(file).filename().string();
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator at(folder / inside, code), end; !code && at != end && names.size() < most;
       at.increment(code)) {
    // Names begin alike; others are near by their ending only.
    const std::string other = lower_case(at->path().filename().string());
    const bool alike = !name.empty() && other.front() == lower_case(name).front();
    if (alike && is_recording(at->path()) && !is_folder(at->path())) {
      names.push_back((inside / at->path().filename()).generic_string());
    }
  }
  std::ranges::sort(names);
  return suggestion(file, names);
}

// A file that was meant to be campaign.toml: of another case, or with an ending that the desktop hid.
bool is_misnamed_toml(const fs::path& path) {
  const std::string name = lower_case(path.filename().string());
  return name.starts_with("campaign") && (name.ends_with(".toml") || name.ends_with(".toml.txt")) && !is_folder(path);
}

// In a folder without campaign.toml.
void tell_misnamed_toml(const fs::path& folder, const ReadOptions& options) {
  if (!options.remark) return;
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    if (is_misnamed_toml(at->path())) names.push_back(at->path().filename().string());
  }
  if (names.empty()) return;
  const std::string name = *std::ranges::min_element(names);
  options.remark({valid_utf8((folder / name).string()), Remark::Kind::dialect, "misnamed campaign.toml",
                  "it is not read, and its roles and laws are not taken: expected the name campaign.toml"});
}

void add_folder(const fs::path& folder, const ReadOptions& options, const TakenOfCampaign& taken, Campaign& campaign,
                std::vector<Item>& items) {
  const fs::path base = absolute_folder(folder);
  const fs::path toml = folder / "campaign.toml";
  std::error_code code;
  CampaignFile declared;
  if (fs::exists(toml, code)) {
    declared = read_campaign_file(toml);
    merge(campaign, declared, taken, toml.string());
  } else {
    tell_misnamed_toml(folder, options);
  }
  for (const auto& entry : declared.entries) {
    const fs::path path = folder / entry.file;
    if (!fs::exists(path, code) || is_folder(path)) {
      throw InputError(toml.string(), entry.line,
                       "there is no recording " + in_quotes(entry.file) + " in the folder" +
                           nearest_beside(folder, entry.file) + ", expected a file with one");
    }
    items.push_back({path,
                     entry.file,
                     base,
                     entry.role,
                     {toml.string(), entry.role_line},
                     entry.numbers,
                     entry.start,
                     entry.start_has_zone,
                     entry.start_line});
  }
  if (!declared.entries.empty()) return;
  const auto names = names_in(folder);
  if (names.empty())
    throw InputError(folder.string(), 0,
                     "the folder holds no recordings, expected files such as .csv, .mat, .tdms, .mf4, .rsp or .xlsx");
  for (const auto& name : names) items.push_back({folder / name, name, base, Role::unassigned});
}

void refuse_repeats(const std::vector<Item>& items) {
  std::set<std::string> seen;
  for (const auto& item : items) {
    std::error_code code;
    auto path = fs::weakly_canonical(item.path, code);
    if (!seen.insert((code ? item.path : path).string()).second) {
      throw InputError(item.path.string(), 0, "the recording is given twice, expected each once");
    }
  }
}

// Puts parent folders before equal names until all differ. Never reaches an absolute path: the files are different.
void tell_apart(std::vector<Item>& items) {
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, int> count;
    for (const auto& item : items) ++count[item.name];
    for (auto& item : items) {
      if (count[item.name] < 2 || !item.base.has_filename()) continue;
      item.name = item.base.filename().string() + "/" + item.name;
      item.base = item.base.parent_path();
      changed = true;
    }
  }
}

}  // namespace

Recording load_recording(const fs::path& path, const ReadOptions& options) {
  const InputFormat* format = find_format(path);
  if (format == nullptr) {
    throw InputError(path.string(), 0,
                     "unknown kind of file " + in_quotes(extension_of(path)) + ", expected " + list_of_endings() +
                         ", or a folder of recordings");
  }
  Recording recording;
  if (format->read != nullptr) {
    recording = format->read(path, options);
  } else {
    const std::string bytes = read_file(path);
    recording = format->parse(bytes, path.string(), options);
    recording.sha256 = sha256_hex(bytes);
  }
  recording.file = valid_utf8(path.filename().string());
  return recording;
}

namespace {

// Limits what each recording may keep so that all keep no more than was asked for.
void limit_each(const std::vector<Item>& items, ReadOptions& of_each) {
  const std::size_t total = of_each.keep_samples;
  constexpr std::uintmax_t shortest_row = 6;  // bytes, of a text
  std::uintmax_t bytes = 0;
  for (const Item& item : items) {
    std::error_code code;
    const std::uintmax_t size = fs::file_size(item.path, code);
    bytes += code ? 0 : size;
  }
  if (total == 0 || bytes / shortest_row <= total) return;
  std::vector<std::size_t> samples;
  for (const Item& item : items) {
    // What is no recording is told when it is read.
    const InputFormat* format = find_format(item.path);
    samples.push_back(format == nullptr ? 0 : format->samples(item.path));
  }
  of_each.keep_samples = kept_of_each(samples, total);
  of_each.samples_of_all = std::accumulate(samples.begin(), samples.end(), std::size_t{0});
}

bool has_start(const Recording& recording) { return recording.started.has_value(); }

double first_start(const std::vector<Recording>& recordings) {
  return *std::ranges::min(recordings, {}, [](const Recording& one) { return *one.started; }).started;
}

// Where every recording says when it was started, the time since the first is kept beside the unused columns. One start
// that is not told takes it from all.
void tell_clock(std::vector<Recording>& recordings, const ReadOptions& options) {
  if (std::ranges::none_of(recordings, has_start)) return;
  for (const Recording& recording : recordings) {
    if (recording.started || !options.remark) continue;
    const std::string text = "no start that can be read, while other recordings have one: the clock is left out of all";
    options.remark({recording.file, Remark::Kind::dialect, text, text});
  }
  if (recordings.size() < 2 || !std::ranges::all_of(recordings, has_start)) return;
  const double first = first_start(recordings);
  for (Recording& recording : recordings) recording.unused.push_back({"clock [s]", *recording.started - first});
}

// A start by its clock: UTC where the text has a zone, else that of the place.
struct ZonedStart {
  double seconds = 0.0;
  bool has_zone = false;
  [[nodiscard]] std::string text() const { return clock_text(seconds) + (has_zone ? "Z" : ""); }
};

// Whether two texts of one start may be so far apart: by what a rounding to seconds or minutes leaves, and where one of
// them tells its zone alone, by the offset of any.
bool may_be_one(const ZonedStart& one, const ZonedStart& other) {
  constexpr double minute = 60.0;
  constexpr double furthest_zone = 14.0 * 3600.0;
  constexpr double step_of_zones = 900.0;
  const auto is_whole = [](const ZonedStart& start) { return std::fmod(start.seconds, minute) == 0.0; };
  const double rounding = is_whole(one) || is_whole(other) ? minute : 1.0;
  double apart = std::fabs(one.seconds - other.seconds);
  if (one.has_zone != other.has_zone && apart <= furthest_zone + rounding) {
    apart = std::fabs(std::remainder(apart, step_of_zones));
  }
  return apart < rounding;
}

// A start in campaign.toml goes before that of the file.
void tell_two_starts(const Recording& recording, const ZonedStart& own, const ZonedStart& declared, int line,
                     const ReadOptions& options) {
  if (!options.remark || may_be_one(own, declared)) return;
  options.remark({recording.file, Remark::Kind::implausible, "two starts",
                  "it was started at " + declared.text() + " by line " + std::to_string(line) +
                      " of campaign.toml and at " + own.text() +
                      " by the file itself, expected one start: that of campaign.toml is taken"});
}

// Both are in SI, and "2.3 bar" and "230 kPa" differ there by their rounding.
bool is_one_number(const ConditionNumber& one, const ConditionNumber& other) {
  constexpr double rounding = 1e-12;
  const double from_kelvin = one.unit == "degC" ? 273.15 : 0.0;
  const double size = std::max(std::fabs(one.value), std::fabs(other.value)) + from_kelvin;
  return std::fabs(one.value - other.value) <= rounding * size;
}

// A number that is given for all recordings goes before those of campaign.toml.
void tell_two_numbers(const Item& item, const ReadOptions& options) {
  if (!options.remark) return;
  for (const auto& [name, number] : options.numbers) {
    const auto declared = item.numbers.find(name);
    if (declared == item.numbers.end() || is_one_number(declared->second, number)) continue;
    const auto text = [](const ConditionNumber& one) {
      constexpr int digits_that_differ = 6;
      return number_text(one.value, digits_that_differ) + (one.unit.empty() ? "" : " " + one.unit);
    };
    options.remark({valid_utf8(item.name), Remark::Kind::implausible, "two numbers " + name,
                    "its " + name + " is " + text(declared->second) + " by line " +
                        std::to_string(declared->second.line) + " of campaign.toml and " + text(number) + " by " +
                        Option::at + ", expected one number: that of " + Option::at + " is taken"});
  }
}

// A number of the clock takes the place of the start, and what was before the recording is no longer known.
void tell_start_not_taken(const Recording& recording, bool has_zone, const Item& item, const ReadOptions& options) {
  if (!options.remark || !recording.started) return;
  const std::string clock(clock_condition);
  const Message by = options.numbers.contains(clock)
                         ? Message(Option::at)
                         : Message("line " + std::to_string(item.numbers.at(clock).line) + " of campaign.toml");
  options.remark({recording.file, Remark::Kind::implausible, "start beside a clock",
                  "its start, " + ZonedStart{*recording.started, has_zone}.text() + ", is not taken, since " + by +
                      " gives its clock as a number; expected one of the two"});
}

// Starts with a zone are in UTC, those without are by the clock of a place: between the two hours may be missing.
void tell_zones(const std::vector<Recording>& recordings, const std::vector<bool>& has_zone,
                const ReadOptions& options) {
  const auto first = [&](bool zone) {
    return static_cast<std::size_t>(std::ranges::find(has_zone, zone) - has_zone.begin());
  };
  const std::size_t with = first(true);
  const std::size_t without = first(false);
  if (!options.remark || with == recordings.size() || without == recordings.size()) return;
  if (!std::ranges::all_of(recordings, has_start)) return;  // none is used
  options.remark({recordings[without].file, Remark::Kind::implausible, "zone of start",
                  "its start, " + ZonedStart{*recordings[without].started, false}.text() +
                      ", names no time zone, and that of " + recordings[with].file + ", " +
                      ZonedStart{*recordings[with].started, true}.text() +
                      ", is in UTC: it was taken in UTC as well; expected a zone in all starts or in none"});
}

// Where parameters follow the clock and no recording holds a column or a number of it, it is that of the starts.
void follow_clock(std::vector<Recording>& recordings) {
  const auto has_clock = [](const Recording& recording) {
    return std::ranges::find(recording.conditions, clock_condition, &ConditionChannel::name) !=
           recording.conditions.end();
  };
  if (std::ranges::all_of(recordings, has_clock)) return;
  for (const Recording& recording : recordings) {
    if (recording.started && !has_clock(recording)) continue;
    throw InputError(
        recording.file +
        (recording.started ? ": has a column 'clock', and other recordings have none"
                           : ": says no start, and parameters follow the clock") +
        "; expected a column 'clock' in all of them, or a comment `# start: 2026-11-24T14:50:58` above the "
        "rows, or starts in campaign.toml");
  }
  const double first = first_start(recordings);
  for (Recording& recording : recordings) {
    const auto at = std::ranges::lower_bound(recording.conditions, clock_condition, {}, &ConditionChannel::name);
    recording.conditions.insert(at, {std::string(clock_condition), "s", {*recording.started - first}});
  }
}

void refuse_all_held_out(const std::vector<Item>& items) {
  if (!std::ranges::all_of(items, [](const Item& item) { return item.role == Role::validate; })) return;
  const LineOfFile& first = items.front().role_at;
  throw InputError(first.file, first.line,
                   items.size() == 1
                       ? "the only recording has the role validate, expected one with the role fit"
                       : fmt::format("all {} recordings have the role validate, expected one or more with "
                                     "the role fit",
                                     items.size()));
}

}  // namespace

Campaign load_campaign(const std::vector<std::string>& data, const ReadOptions& options, const TakenOfCampaign& taken) {
  if (data.empty()) throw InputError("no recordings given, expected files or folders of them");
  Campaign campaign;
  std::vector<Item> items;
  std::vector<GivenRecording> given;
  std::set<fs::path> read;  // absolute folders
  for (const auto& argument : data) {
    const fs::path path(argument);
    if (is_folder(path)) {
      const std::size_t before = items.size();
      add_folder(path, options, taken, campaign, items);
      read.insert(absolute_folder(path));
      std::error_code code;
      if (fs::exists(path / "campaign.toml", code)) continue;
      for (std::size_t k = before; k < items.size(); ++k) given.push_back({items[k].path, GivenBy::folder});
    } else {
      // What is not there is told before anything is read.
      std::error_code code;
      if (!fs::exists(path, code)) (void)InputFile(path);
      items.push_back({path, path.filename().string(), absolute_folder(path.parent_path()), Role::unassigned});
      given.push_back({path, GivenBy::name});
    }
  }
  refuse_repeats(items);
  if (taken.roles) refuse_all_held_out(items);
  tell_unread_campaigns(given, read, options, taken);
  tell_apart(items);
  ReadOptions of_each = options;
  of_each.follows_frequency = options.follows_frequency || !campaign.by_frequency.empty();
  limit_each(items, of_each);
  for (const auto& [condition, orders] : campaign.by) {
    const auto at = std::ranges::lower_bound(of_each.conditions, condition);
    if (at == of_each.conditions.end() || *at != condition) of_each.conditions.insert(at, condition);
  }
  std::vector<bool> zones;  // whether the starts have one
  for (const auto& item : items) {
    tell_two_numbers(item, options);
    of_each.numbers = item.numbers;
    for (const auto& [name, number] : options.numbers) of_each.numbers.insert_or_assign(name, number);
    bool has_zone = false;
    of_each.start_zone = [&has_zone](bool zone) { has_zone = zone; };
    campaign.recordings.push_back(load_recording(item.path, of_each));
    campaign.recordings.back().file = valid_utf8(item.name);
    remark_on_numbers(of_each, valid_utf8(item.name));
    take_numbers(campaign.recordings.back(), of_each);
    if (item.start) {
      std::optional<double>& started = campaign.recordings.back().started;
      const ZonedStart declared{*item.start, item.start_has_zone};
      if (started) {
        tell_two_starts(campaign.recordings.back(), {*started, has_zone}, declared, item.start_line, options);
      }
      started = item.start;
      has_zone = item.start_has_zone;
    }
    zones.push_back(has_zone);
    // A number for the clock is meant, wherever the starts lie.
    if (of_each.numbers.contains(std::string(clock_condition))) {
      tell_start_not_taken(campaign.recordings.back(), has_zone, item, options);
      campaign.recordings.back().started.reset();
    }
    campaign.roles.push_back(item.role);
  }
  tell_zones(campaign.recordings, zones, options);
  if (std::ranges::find(of_each.conditions, clock_condition) == of_each.conditions.end()) {
    tell_clock(campaign.recordings, options);
  } else {
    follow_clock(campaign.recordings);
  }
  agree_on_units(campaign.recordings);
  if (const auto wrong = carry_work(campaign.recordings); wrong && options.remark) {
    options.remark({wrong->file, Remark::Kind::dialect, wrong->why, wrong->why});
  }
  return campaign;
}

}  // namespace hysteron
