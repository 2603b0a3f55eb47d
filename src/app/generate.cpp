// hysteron generate: writes a dataset that ships with the program as a campaign folder.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "datasets/dataset.hpp"
#include "io/output.hpp"

namespace hysteron {

const DatasetEntry* find_dataset(std::string_view id) {
  for (const DatasetEntry* entry : dataset_catalogue()) {
    if (entry->id == id) {
      return entry;
    }
  }
  return nullptr;
}

}  // namespace hysteron

namespace hysteron::app {

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
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_option("--only", options->only, "only recordings whose name contains this, e.g. 2.0Hz");
  command->add_option("--seed", options->seed, "seed of the noise")
      ->transform(seed_number())
      ->capture_default_str();
  command->footer("Example:\n  hysteron generate rd8040-twin --out twin --only 2.0Hz");
  command->callback([options] {
    const DatasetEntry* entry = find_dataset(options->id);
    if (entry == nullptr) {
      throw InputError("unknown dataset '" + options->id + "', see `hysteron list datasets`");
    }
    const Campaign campaign = entry->generate(Stream(options->seed).child(entry->id));
    if (std::ranges::none_of(campaign.recordings, [&](const Recording& recording) {
          return recording.file.find(options->only) != std::string::npos;
        })) {
      throw InputError("--only: no recording's name contains '" + options->only + "'");
    }
    make_output_folder(options->out);
    std::size_t written = 0;
    for (const Recording& recording : campaign.recordings) {
      if (recording.file.find(options->only) == std::string::npos) {
        continue;
      }
      std::string text = "time [s],displacement [m],velocity [m/s],force [N],current [A]\n";
      for (std::size_t n = 0; n < recording.size(); ++n) {
        text += fmt::format("{},{},{},{},{}\n", recording.time[n], recording.displacement[n], recording.velocity[n],
                            recording.force[n], recording.drive[n]);
      }
      write_file_atomically(std::filesystem::path(options->out) / recording.file, text);
      ++written;
    }
    fmt::print("{} recordings in {}\n", written, options->out);
  });
}

}  // namespace hysteron::app
