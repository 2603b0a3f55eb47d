// hysteron simulate: the force of an identified model, or of a published parameter set, on a recording's motion.
#include <cmath>
#include <map>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "io/output.hpp"
#include "task/predict.hpp"
#include "task/published.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::vector<std::string> words;  // MODEL RECORDING, or RECORDING alone with a preset
  DataOptions data;
  std::string preset;
  std::vector<std::string> set;
  double drive = std::nan("");
  std::string out;
  double tolerance = 1e-4;
};

// Of --set, by name.
std::map<std::string, double> quantities_of(const std::vector<std::string>& words, const std::string& preset) {
  std::map<std::string, double> result;
  for (const std::string& word : words) {
    const auto [name, value] = split_pair("--set", word, "QUANTITY=NUMBER, see `hysteron describe " + preset + "`");
    if (!result.emplace(name, parse_number("--set", value)).second) {
      throw InputError("--set: '" + name + "' is given twice, expected each quantity once");
    }
  }
  return result;
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "simulate", "predicted force of a fitted model or a published parameter set on the motion of a recording");
  command
      ->add_option("MODEL RECORDING", options->words,
                   "model.json written by fit or diagnose, then one recording; its force may be missing. With "
                   "--preset the recording alone")
      ->required()
      ->expected(1, 2);
  command->add_option("--preset", options->preset, "published parameter set, see `hysteron describe MODEL`");
  command->add_option("--set", options->set, "QUANTITY=NUMBER of the preset, in its printed unit; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--drive", options->drive, "constant current or voltage for the preset, instead of the recording's")
      ->check(real_number(-1e9, 1e9));
  add_reading_options(*command, options->data);
  add_at_option(*command, options->data);
  add_without_time_option(*command, options->data);
  command
      ->add_option("--out", options->out,
                   "file to write, CSV, or MAT by its ending .mat: time [s],force [N]; -: standard output")
      ->required();
  command->add_option("--tolerance", options->tolerance, "relative force error allowed to the integration")
      ->check(real_number(1e-10, 1e-2))
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  hysteron simulate out/model.json recordings/r1.csv --out prediction.csv\n"
      "  hysteron simulate --preset spencer-1997 --drive 1.5 recordings/r1.csv --out prediction.csv");
  take_common_options(*command);
  command->callback([options] {
    const bool preset = !options->preset.empty();
    if (options->words.size() != (preset ? 1U : 2U)) {
      throw InputError(preset ? "simulate --preset: expected RECORDING alone"
                              : "simulate: expected MODEL and RECORDING");
    }
    if (preset && (options->data.without_time || !options->data.at.empty())) {
      throw InputError("simulate: --without-time and --at belong to a model.json");
    }
    if (!preset && (!options->set.empty() || !std::isnan(options->drive))) {
      throw InputError("simulate: --set and --drive belong to --preset");
    }
    check_table(options->out, options->words);
    const Preset* chosen = preset ? &preset_called(options->preset) : nullptr;
    const std::map<std::string, double> quantities = quantities_of(options->set, options->preset);
    StoredModel stored;
    if (!preset) {
      stored = read_model(options->words[0]);
    }
    options->data.data = {options->words.back()};
    options->data.taken = recordings_alone;
    if (!preset) {
      options->data.conditions = conditions_of({&stored});
      options->data.follows_frequency = stored.follows_frequency();
      refuse_unfollowed({&stored}, numbers_at(options->data));
    }
    const Campaign campaign = load(options->data, Required::motion);
    if (campaign.recordings.size() != 1) {
      throw InputError(options->data.data[0] + ": holds " + std::to_string(campaign.recordings.size()) +
                       " recordings, expected one");
    }
    const Recording& recording = campaign.recordings[0];
    std::vector<std::string> remarks;
    std::vector<double> force;
    try {
      force = preset ? force_of_preset(*chosen, quantities, options->drive, recording, options->tolerance, remarks)
                     : simulated_force(stored, options->words[0], recording, options->tolerance, remarks);
    } catch (...) {
      warn_of(remarks);  // a force that runs away may do so for what they say
      throw;
    }
    warn_of(remarks);
    write_table(options->out, csv_of_prediction(recording.time, force));
  });
}

}  // namespace hysteron::app
