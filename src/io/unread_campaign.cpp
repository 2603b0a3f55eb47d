#include "io/unread_campaign.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/joined.hpp"
#include "core/printable.hpp"
#include "io/campaign_file.hpp"
#include "io/file.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

// What of a campaign.toml would be taken were its folder given and not these files of it; empty where nothing would.
std::vector<std::string> not_taken_of(const CampaignFile& declared, const std::vector<std::string>& files, bool alone,
                                      const ReadOptions& options, const TakenOfCampaign& taken) {
  std::vector<const CampaignEntry*> entries;
  for (const CampaignEntry& entry : declared.entries) {
    if (std::ranges::find(files, entry.file) != files.end()) entries.push_back(&entry);
  }
  // With their folder such files are not read at all.
  if (entries.empty() && !declared.entries.empty()) return {};
  const auto of_entries = [&](const auto& has) {
    return std::ranges::any_of(entries, [&](const CampaignEntry* entry) { return has(*entry); });
  };
  const bool laws =
      std::ranges::any_of(declared.lines_of_laws, [&](const auto& law) { return taken.laws_in(law.first.first); });
  // A model that is identified needs of the numbers those that its laws follow, without which it is refused, and what
  // a recording without a column of it is taken to be without.
  const auto is_missed = [&](const auto& number) {
    const std::string& name = number.first;
    const bool channel = name == "current" || name == "voltage" || name == "temperature";
    return !options.numbers.contains(name) && (taken.laws || channel);
  };
  std::vector<std::string> result;
  if (taken.model && !declared.model.empty()) result.emplace_back("model");
  if (laws) result.emplace_back("laws");
  if (taken.roles && of_entries([](const CampaignEntry& entry) { return entry.role == Role::validate; })) {
    result.emplace_back("roles");
  }
  // One start tells nothing of what was before it.
  if (!alone && of_entries([](const CampaignEntry& entry) { return entry.start.has_value(); })) {
    result.emplace_back("starts");
  }
  if (of_entries([&](const CampaignEntry& entry) { return std::ranges::any_of(entry.numbers, is_missed); })) {
    result.emplace_back("numbers");
  }
  return result;
}

constexpr int folders_above = 2;

// A campaign.toml with the recordings that it may say something of, by their names in it.
struct Unread {
  bool beside = false;  // these recordings, not in a folder below
  std::vector<std::string> files;
};

std::map<fs::path, Unread> unread_of(const std::vector<GivenRecording>& recordings, const std::set<fs::path>& read) {
  std::map<fs::path, Unread> result;
  for (const GivenRecording& one : recordings) {
    fs::path folder = one.path.parent_path();
    fs::path absolute = absolute_folder(folder);
    fs::path name = one.path.filename();
    for (int above = 0; above <= folders_above; ++above) {
      const fs::path toml = (folder / "campaign.toml").lexically_normal();
      std::error_code code;
      const bool looked_at = above > 0 || one.by == GivenBy::name;
      if (looked_at && !read.contains(absolute) && fs::is_regular_file(toml, code)) {
        Unread& unread = result[toml];
        unread.beside = unread.beside || above == 0;
        unread.files.push_back(name.generic_string());
      }
      if (!absolute.has_filename()) break;
      name = absolute.filename() / name;
      absolute = absolute.parent_path();
      folder /= "..";
    }
  }
  return result;
}

bool lists_one_of(const CampaignFile& declared, const std::vector<std::string>& files) {
  return std::ranges::any_of(declared.entries, [&](const CampaignEntry& entry) {
    return std::ranges::find(files, entry.file) != files.end();
  });
}

// What a caller may give in place of the file.
std::string given_later(const std::vector<std::string>& parts) {
  std::vector<std::string> both;
  for (const char* part : {"model", "laws"}) {
    if (std::ranges::find(parts, part) != parts.end()) both.emplace_back(part);
  }
  return both.empty() ? std::string() : ", or its " + joined(both, " and ") + " given to fit or diagnose";
}

}  // namespace

void tell_unread_campaigns(const std::vector<GivenRecording>& recordings, const std::set<fs::path>& read,
                           const ReadOptions& options, const TakenOfCampaign& taken) {
  if (!options.remark) return;
  for (const auto& [toml, unread] : unread_of(recordings, read)) {
    std::string what;
    std::string later;
    try {
      const CampaignFile declared = read_campaign_file(toml);
      // Of folders below its own it says nothing but what it lists.
      if (!unread.beside && !lists_one_of(declared, unread.files)) continue;
      const std::vector<std::string> parts =
          not_taken_of(declared, unread.files, recordings.size() == 1, options, taken);
      if (parts.empty()) continue;
      what = ", and its " + joined(parts, " and ") +
             (parts == std::vector<std::string>{"model"} ? " is not taken" : " are not taken");
      if (taken.given_later) later = given_later(parts);
    } catch (const InputError&) {  // nor could it be
      if (!unread.beside) continue;
    }
    const std::string file = valid_utf8(toml.string());
    options.remark({file, Remark::Kind::dialect, "unread " + file,
                    std::string(unread.beside ? "it is not read, as recordings beside it are given one by one"
                                              : "it is not read, as recordings that it lists are given without its "
                                                "folder") +
                        what + ": expected the folder in their place, for what it says of them" + later});
  }
}

}  // namespace hysteron
