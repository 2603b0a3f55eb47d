#include "task/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"
#include "fit/predict.hpp"
#include "fit/start.hpp"
#include "simulate/composite.hpp"
#include "task/finite.hpp"

namespace hysteron {
namespace {

// In the order of the preset, NaN for those that its source prints and that are not given.
std::vector<double> given_quantities(const Preset& preset, const std::map<std::string, double>& values) {
  std::vector<double> given(preset.quantities.size(), std::nan(""));
  for (const auto& [name, value] : values) {
    const auto found = std::ranges::find(preset.quantities, name, &PresetQuantity::name);
    if (found == preset.quantities.end()) {
      std::vector<std::string> known;
      for (const PresetQuantity& quantity : preset.quantities) known.emplace_back(quantity.name);
      throw OptionError(Option::set + ": '" + name + "' is no quantity of the preset" + suggestion(name, known) +
                        ", see `hysteron describe " + std::string(preset.id) + "`");
    }
    given[static_cast<std::size_t>(found - preset.quantities.begin())] = value;
  }
  Message missing("");
  bool complete = true;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (preset.quantities[k].at == nullptr && std::isnan(given[k])) {
      missing += " " + Option::set + " " + std::string(preset.quantities[k].name) + "=...";
      complete = false;
    }
  }
  if (!complete) {
    throw OptionError("preset " + std::string(preset.id) + ": its source does not print every quantity, expected" +
                      missing);
  }
  return given;
}

}  // namespace

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

std::vector<double> force_of_preset(const Preset& preset, const std::map<std::string, double>& quantities, double drive,
                                    Recording recording, double tolerance, std::vector<std::string>& remarks) {
  // Of the force only how it begins: in its cycle, or from nothing.
  recording.start = start_of(recording);
  recording.force.clear();
  const std::vector<double> given = given_quantities(preset, quantities);
  if (!std::isnan(drive)) {
    recording.drive.assign(recording.size(), drive);
  } else if (preset.drive != PresetDrive::none && !recording.drive.empty() &&
             (recording.drive_kind == DriveKind::voltage) != (preset.drive == PresetDrive::voltage)) {
    const bool voltage = preset.drive == PresetDrive::voltage;
    throw OptionError(recording.file + ": records a " + (voltage ? "current" : "voltage") + ", expected a " +
                      (voltage ? "voltage" : "current") + " for preset " + std::string(preset.id) +
                      " or its value with " + Option::drive);
  }
  if (preset.drive != PresetDrive::none && recording.drive.empty()) {
    throw OptionError(recording.file + ": has no current or voltage, expected one for preset " +
                      std::string(preset.id) + " or its value with " + Option::drive);
  }
  recording.drive = lagged(recording.time, recording.drive, preset.lag);
  const auto outside = std::ranges::count_if(
      recording.drive, [&](double value) { return value < preset.drive_low || value > preset.drive_high; });
  if (preset.drive != PresetDrive::none && outside > 0) {
    remarks.push_back(fmt::format("{}: {} samples have a drive outside {} to {}, the range of preset {}",
                                  recording.file, outside, preset.drive_low, preset.drive_high, preset.id));
  }
  const double frequency = preset.by_frequency ? dominant_frequency(recording) : 0.0;
  const auto parameters = [&](double at) {
    std::vector<double> values = given;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isnan(values[k])) {
        values[k] = preset.quantities[k].at(at, frequency);
      }
    }
    return preset.parameters(values);
  };
  const CompositeModel model = make_model(preset.model, {preset.effects.begin(), preset.effects.end()});
  ObjectiveOptions objective;
  objective.tolerance = tolerance;
  const Target target = make_target(recording, objective);
  if (recording.drive.empty() || !target.inputs_vary) {
    std::vector<double> constant =
        predict(model, parameters(recording.drive.empty() ? 0.0 : recording.drive.front()), {}, target);
    require_finite(constant, recording);
    return constant;
  }
  // A drive that varies: parameters sample by sample, from rest.
  const std::size_t count = model.parameter_count();
  std::vector<double> all;
  for (const double at : recording.drive) {
    const std::vector<double> values = parameters(at);
    all.insert(all.end(), values.begin(), values.end());
  }
  std::vector<double> state(static_cast<std::size_t>(model.states()), 0.0);
  std::vector<double> force(recording.size());
  Motion motion = target.motion;
  motion.lead = 0.0;
  model.march<double>(motion, all.data(), count, 0, recording.size(), state.data(), force.data());
  require_finite(force, recording);
  return force;
}

}  // namespace hysteron
