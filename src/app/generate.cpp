// hysteron generate: writes a dataset that ships with the program as a campaign folder.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "datasets/support/shipped.hpp"
#include "io/file.hpp"
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

// Measured recordings go byte for byte, with their card, their licence and the checksums of those written.
void copy_shipped(const DatasetEntry& entry, const Campaign& campaign, const std::string& only,
                  const std::filesystem::path& out) {
  const std::filesystem::path folder = shipped_folder(entry.id);
  std::string sums;
  for (const Recording& recording : campaign.recordings) {
    if (recording.file.find(only) == std::string::npos) continue;
    write_file_atomically(out / recording.file, read_file(folder / recording.file));
    sums += recording.sha256 + "  " + recording.file + "\n";
  }
  for (const char* name : {"README.md", "LICENSE"}) write_file_atomically(out / name, read_file(folder / name));
  write_file_atomically(out / shipped_checksums, sums);
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
    make_output_folder(options->out);
    const auto written = std::ranges::count_if(campaign.recordings, [&](const Recording& recording) {
      return recording.file.find(options->only) != std::string::npos;
    });
    if (!entry->licence.empty()) {
      copy_shipped(*entry, campaign, options->only, options->out);
    } else {
      for (const Recording& recording : campaign.recordings) {
        if (recording.file.find(options->only) == std::string::npos) continue;
        write_file_atomically(std::filesystem::path(options->out) / recording.file, csv_of_simulated(recording));
      }
      if (const std::string toml = campaign_toml(campaign, options->only); !toml.empty()) {
        write_file_atomically(std::filesystem::path(options->out) / "campaign.toml", toml);
      }
    }
    fmt::print("{} recordings in {}\n", written, options->out);
  });
}

}  // namespace hysteron::app
