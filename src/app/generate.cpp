// hysteron generate: writes a dataset that ships with the program as a campaign folder.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"
#include "io/file.hpp"
#include "io/format.hpp"
#include "io/output.hpp"
#include "task/dataset.hpp"

namespace hysteron::app {
namespace {

// Roles and laws, where the dataset says any; the roles of those written.
std::string campaign_toml(const Campaign& campaign, const std::string& only) {
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role != Role::unassigned; });
  if (!roles && campaign.by_current.empty() && campaign.by_frequency.empty()) return {};
  std::string text = fmt::format("schema = \"hysteron.campaign/1\"\nmodel = \"{}\"\n", campaign.model);
  for (const auto& [section, laws] :
       {std::pair{"by_current", campaign.by_current}, {"by_frequency", campaign.by_frequency}}) {
    if (laws.empty()) continue;
    text += fmt::format("\n[{}]\n", section);
    for (const auto& [name, order] : laws) text += fmt::format("{} = {}\n", name, order);
  }
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    if (campaign.roles[k] == Role::unassigned || campaign.recordings[k].file.find(only) == std::string::npos) continue;
    text += fmt::format("\n[[recording]]\nfile = \"{}\"\nrole = \"{}\"\n", campaign.recordings[k].file,
                        campaign.roles[k] == Role::fit ? "fit" : "validate");
  }
  return text;
}

// Names and contents of the files of the recordings chosen. Measured ones go byte for byte, with their card, their
// licence and the checksums of those written.
std::map<std::string, std::string> files_of(const DatasetEntry& entry, const Campaign& campaign,
                                            const std::string& only) {
  std::map<std::string, std::string> files;
  const bool shipped = !entry.licence.empty();
  std::string sums;
  for (const Recording& recording : campaign.recordings) {
    if (recording.file.find(only) == std::string::npos) continue;
    files[recording.file] =
        shipped ? read_file(shipped_folder(entry.id) / recording.file) : csv_of_simulated(recording);
    sums += recording.sha256 + "  " + recording.file + "\n";
  }
  if (shipped) {
    for (const char* name : {"README.md", "LICENSE"}) files[name] = read_file(shipped_folder(entry.id) / name);
    files[std::string(shipped_checksums)] = sums;
  } else if (std::string toml = campaign_toml(campaign, only); !toml.empty()) {
    files["campaign.toml"] = std::move(toml);
  }
  return files;
}

// Recordings of another hand would be read with those of the dataset.
void refuse_other_recordings(const std::filesystem::path& folder, const Campaign& campaign) {
  std::error_code code;
  for (std::filesystem::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    const std::string name = at->path().filename().string();
    const bool own = std::ranges::find(campaign.recordings, name, &Recording::file) != campaign.recordings.end();
    if (own || in_folders(at->path()) != InFolders::all || !at->is_regular_file(code)) continue;
    throw InputError("--out " + folder.string() + ": " + name +
                     " is there, which is no recording of the dataset, expected another folder");
  }
}

// What is there of another hand would be lost, or rule the folder.
void refuse_others(const std::filesystem::path& folder, const std::map<std::string, std::string>& files) {
  const auto refuse = [&](const std::string& name, const std::string& why) {
    throw InputError("--out " + folder.string() + ": " + name + " is there" + why + ", expected another folder");
  };
  std::error_code code;
  for (const auto& [name, text] : files) {
    if (std::filesystem::is_regular_file(folder / name, code) && read_file(folder / name) != text) {
      refuse(name, " and differs from what would be written");
    }
  }
  if (!files.contains("campaign.toml") && std::filesystem::exists(folder / "campaign.toml", code)) {
    refuse("campaign.toml", ", which the dataset does not have");
  }
}

// The one recording chosen, on standard output.
void print_one(const DatasetEntry& entry, const Campaign& campaign, const std::string& only) {
  std::vector<const Recording*> chosen;
  for (const Recording& recording : campaign.recordings) {
    if (recording.file.find(only) != std::string::npos) chosen.push_back(&recording);
  }
  if (chosen.size() != 1) {
    refuse_standard_output("-", fmt::format("{} recordings; --only chooses one", chosen.size()));
  }
  write_result("-", entry.licence.empty() ? csv_of_simulated(*chosen.front())
                                          : read_file(shipped_folder(entry.id) / chosen.front()->file));
}

}  // namespace

void add_generate(CLI::App& program) {
  struct Options {
    std::string id;
    std::string out;
    std::string only;
    std::uint64_t seed = 1;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("generate", "writes a shipped dataset as a folder of recordings");
  command->add_option("DATASET", options->id, "an id of `hysteron list datasets`")->required();
  command->add_option("--out", options->out, "folder to write; -: standard output for one recording")->required();
  command->add_option("--only", options->only, "only recordings whose name contains this, e.g. 2.0Hz");
  command->add_option("--seed", options->seed, "seed of a simulated dataset's noise")
      ->transform(seed_number())
      ->capture_default_str();
  command->footer(
      "Examples:\n  hysteron generate rd8040-twin --out twin --only 2.0Hz\n  hysteron generate utfsm-mr-damper --out "
      "press");
  take_common_options(*command);
  command->callback([options] {
    const DatasetEntry* entry = find_dataset(options->id);
    if (entry == nullptr) {
      std::vector<std::string> known;
      for (const DatasetEntry* one : dataset_catalogue()) known.emplace_back(one->id);
      throw InputError("unknown dataset '" + options->id + "'" + suggestion(options->id, known) +
                       ", see `hysteron list datasets`");
    }
    const Campaign campaign = entry->generate(Stream(options->seed).child(entry->id));
    if (std::ranges::none_of(campaign.recordings, [&](const Recording& recording) {
          return recording.file.find(options->only) != std::string::npos;
        })) {
      throw InputError("--only: no recording's name contains '" + options->only + "'");
    }
    if (is_standard_output(options->out)) {
      print_one(*entry, campaign, options->only);
      return;
    }
    const std::map<std::string, std::string> files = files_of(*entry, campaign, options->only);
    refuse_others(options->out, files);
    refuse_other_recordings(options->out, campaign);
    make_output_folder(options->out);
    for (const auto& [name, text] : files) write_file_atomically(std::filesystem::path(options->out) / name, text);
    const auto written = std::ranges::count_if(campaign.recordings, [&](const Recording& recording) {
      return recording.file.find(options->only) != std::string::npos;
    });
    fmt::print("{} recording{} written to {}\n", written, written == 1 ? "" : "s", printable(options->out));
  });
}

}  // namespace hysteron::app
