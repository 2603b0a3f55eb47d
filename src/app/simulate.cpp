// hysteron simulate: the force of an identified model, or of a published parameter set, on a recording's motion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/frequency.hpp"
#include "core/suggest.hpp"
#include "fit/start.hpp"
#include "io/output.hpp"
#include "presets/preset.hpp"
#include "task/finite.hpp"
#include "task/predict.hpp"

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

const Preset& preset_called(const std::string& id) {
  if (const Preset* preset = find_preset(id)) {
    return *preset;
  }
  std::vector<std::string> known;
  for (const Preset* preset : preset_catalogue()) {
    known.emplace_back(preset->id);
  }
  throw InputError("unknown preset '" + id + "'" + suggestion(id, known) + ", see `hysteron describe MODEL`");
}

// Values of the quantities given with --set, NaN for the others.
std::vector<double> given_quantities(const Preset& preset, const std::vector<std::string>& words) {
  std::vector<double> given(preset.quantities.size(), std::nan(""));
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    const auto found = std::ranges::find_if(
        preset.quantities, [&](const PresetQuantity& quantity) { return quantity.name == word.substr(0, equals); });
    char* end = nullptr;
    const std::string number = equals == std::string::npos ? "" : word.substr(equals + 1);
    const double value = std::strtod(number.c_str(), &end);
    if (found == preset.quantities.end() || number.empty() || *end != '\0' || !std::isfinite(value)) {
      throw InputError("--set: '" + word +
                       "' is not QUANTITY=NUMBER with a quantity of the preset, see `hysteron describe " +
                       std::string(preset.id) + "`");
    }
    double& quantity = given[static_cast<std::size_t>(found - preset.quantities.begin())];
    if (!std::isnan(quantity)) {
      throw InputError("--set: '" + std::string(found->name) + "' is given twice, expected each quantity once");
    }
    quantity = value;
  }
  std::string missing;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (preset.quantities[k].at == nullptr && std::isnan(given[k])) {
      missing += " --set " + std::string(preset.quantities[k].name) + "=...";
    }
  }
  if (!missing.empty()) {
    throw InputError("preset " + std::string(preset.id) + ": its source does not print every quantity, expected" +
                     missing);
  }
  return given;
}

std::vector<double> force_of_preset(const Preset& preset, const Options& options, Recording recording) {
  const std::vector<double> given = given_quantities(preset, options.set);
  if (!std::isnan(options.drive)) {
    recording.drive.assign(recording.size(), options.drive);
  } else if (preset.drive != PresetDrive::none && !recording.drive.empty() &&
             (recording.drive_kind == DriveKind::voltage) != (preset.drive == PresetDrive::voltage)) {
    throw InputError(recording.file + ": records a " +
                     (recording.drive_kind == DriveKind::voltage ? std::string("voltage") : std::string("current")) +
                     ", preset " + std::string(preset.id) + " needs the other; give its value with --drive");
  }
  if (preset.drive != PresetDrive::none && recording.drive.empty()) {
    throw InputError(recording.file + ": has no current or voltage, expected one for preset " + std::string(preset.id) +
                     " or its value with --drive");
  }
  recording.drive = lagged(recording.time, recording.drive, preset.lag);
  const auto outside = std::ranges::count_if(
      recording.drive, [&](double drive) { return drive < preset.drive_low || drive > preset.drive_high; });
  if (preset.drive != PresetDrive::none && outside > 0) {
    fmt::print(stderr, "warning: {}: {} samples have a drive outside {} to {}, the range of preset {}\n",
               recording.file, outside, preset.drive_low, preset.drive_high, preset.id);
  }
  const double frequency = preset.by_frequency ? dominant_frequency(recording) : 0.0;
  const auto parameters = [&](double drive) {
    std::vector<double> quantities = given;
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      if (std::isnan(quantities[k])) {
        quantities[k] = preset.quantities[k].at(drive, frequency);
      }
    }
    return preset.parameters(quantities);
  };
  const CompositeModel model = make_model(preset.model, {preset.effects.begin(), preset.effects.end()});
  ObjectiveOptions objective;
  objective.tolerance = options.tolerance;
  const Target target = make_target(recording, objective);
  if (recording.drive.empty() || !target.inputs_vary) {
    return predict(model, parameters(recording.drive.empty() ? 0.0 : recording.drive.front()), {}, target);
  }
  // A drive that varies: parameters sample by sample, from rest.
  const std::size_t count = model.parameter_count();
  std::vector<double> all;
  for (const double drive : recording.drive) {
    const std::vector<double> values = parameters(drive);
    all.insert(all.end(), values.begin(), values.end());
  }
  std::vector<double> state(16, 0.0);
  std::vector<double> force(recording.size());
  Motion motion = target.motion;
  motion.lead = 0.0;
  model.march<double>(motion, all.data(), count, 0, recording.size(), state.data(), force.data());
  return force;
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
    StoredModel stored;
    if (!preset) {
      stored = read_model(options->words[0]);
    }
    options->data.data = {options->words.back()};
    if (!preset) {
      options->data.conditions = conditions_of({&stored});
      refuse_unfollowed({&stored}, numbers_at(options->data));
    }
    const Campaign campaign = load(options->data, Required::motion);
    if (campaign.recordings.size() != 1) {
      throw InputError(options->data.data[0] + ": holds " + std::to_string(campaign.recordings.size()) +
                       " recordings, expected one");
    }
    Recording recording = campaign.recordings[0];
    std::vector<double> force;
    if (preset) {
      // Of the force only how it begins: in its cycle, or from nothing.
      recording.start = start_of(recording);
      recording.force.clear();
      force = force_of_preset(*chosen, *options, recording);
      require_finite(force, recording);
    } else {
      std::vector<std::string> remarks;
      force = simulated_force(stored, options->words[0], recording, options->tolerance, remarks);
      warn_of(remarks);
    }
    write_table(options->out, csv_of_prediction(recording.time, force));
  });
}

}  // namespace hysteron::app
