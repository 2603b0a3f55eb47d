#include "task/guesses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/frequency.hpp"
#include "fit/identify.hpp"
#include "fit/layout.hpp"
#include "task/impossible_laws.hpp"
#include "task/remarks.hpp"

namespace hysteron {
namespace {

constexpr double far_beyond = 0.1;  // of what was fitted

std::string alike(std::size_t count) {
  return count < 2 ? "" : fmt::format(" ({} more recording{} alike)", count - 1, count > 2 ? "s" : "");
}

// The recording that is farthest out, and how many are.
struct Farthest {
  std::string file;
  double value = 0.0;
  double by = 0.0;
  std::size_t count = 0;

  void look(const std::pair<double, double>& range, const std::string& name, double low, double high) {
    look(range, name, low, high, range.second - range.first);
  }
  // `size` is that of the range.
  void look(const std::pair<double, double>& range, const std::string& name, double low, double high, double size) {
    const double below = range.first - low;
    const double above = high - range.second;
    const double out = std::max(below, above);
    if (!(out > far_beyond * size)) return;
    ++count;
    if (out <= by) return;
    file = name;
    value = above >= below ? high : low;
    by = out;
  }

  void tell(const std::pair<double, double>& range, const std::string& path, const std::string& what,
            const std::string& unit, std::vector<std::string>& remarks) const {
    if (count == 0) return;
    const std::string behind = unit.empty() ? "" : " " + unit;
    remarks.push_back(
        fmt::format("{}: a {} of {:.3g}{}, and the laws of {} were fitted from {:.3g} to {:.3g}{}: what they say "
                    "beyond is a guess{}",
                    file, what, value, behind, path, range.first, range.second, behind, alike(count)));
  }

  // `factor` is to the unit told.
  void tell_of_model(const std::pair<double, double>& range, const std::string& path, const std::string& what,
                     double factor, const std::string& unit, std::vector<std::string>& remarks) const {
    if (count == 0) return;
    const std::string low = fmt::format("{:.3g}", factor * range.first);
    const std::string high = fmt::format("{:.3g}", factor * range.second);
    remarks.push_back(fmt::format("{}: a {} of {:.3g} {}, and {} was fitted {} {}: what it says beyond is a guess{}",
                                  file, what, factor * value, unit, path,
                                  low == high ? "at " + low : "from " + low + " to " + high, unit, alike(count)));
  }
};

}  // namespace

std::vector<std::string> units_assumed(const StoredModel& stored, const std::string& path) {
  if (stored.assumed_units.empty()) return {};
  const auto& [name, unit] = stored.assumed_units.front();
  const std::size_t others = stored.assumed_units.size() - 1;
  return {fmt::format("{}: no unit beside the value of '{}'{}: taken in SI, '{}' in '{}'", path, name,
                      others == 0 ? "" : fmt::format(" and {} more", others), name, unit)};
}

std::vector<std::string> drive_assumed(const StoredModel& stored, const std::string& path,
                                       const std::vector<Recording>& recordings) {
  if (stored.drive == DriveKind::none) return {};
  const auto lacks = [](const Recording& recording) { return recording.drive.empty(); };
  const auto first = std::ranges::find_if(recordings, lacks);
  if (first == recordings.end()) return {};
  const char* const drive_word = stored.drive == DriveKind::voltage ? "voltage" : "current";
  const auto count = static_cast<std::size_t>(std::ranges::count_if(recordings, lacks));
  return {fmt::format("{}: no {} is read, and parameters of {} follow the {}: taken as zero{}", first->file, drive_word,
                      path, drive_word, alike(count))};
}

namespace {

std::vector<std::string> beyond_laws(const StoredModel& stored, const std::string& path,
                                     const std::vector<Recording>& recordings) {
  std::vector<std::string> remarks;
  const bool voltage = stored.drive == DriveKind::voltage;
  const char* const drive_word = voltage ? "voltage" : "current";
  Farthest drive;
  Farthest frequency;
  for (const Recording& recording : recordings) {
    if (stored.drive_range && !recording.drive.empty() && recording.drive_kind == stored.drive) {
      const auto [low, high] = std::ranges::minmax(recording.drive);
      drive.look(*stored.drive_range, recording.file, low, high);
    }
    if (stored.frequency_range) {
      const double hertz = dominant_frequency(recording);
      frequency.look(*stored.frequency_range, recording.file, hertz, hertz);
    }
  }
  if (stored.drive_range) drive.tell(*stored.drive_range, path, drive_word, voltage ? "V" : "A", remarks);
  if (stored.frequency_range) frequency.tell(*stored.frequency_range, path, "frequency", "Hz", remarks);
  for (std::size_t c = 0; c < stored.conditions.size(); ++c) {
    const ConditionRange& condition = stored.conditions[c];
    if (!(condition.high > condition.low)) continue;  // another model's
    const std::pair range(condition.low, condition.high);
    Farthest farthest;
    for (const Recording& recording : recordings) {
      const auto [low, high] = std::ranges::minmax(recording.conditions[c].values);
      farthest.look(range, recording.file, low, high);
    }
    farthest.tell(range, path, condition.name, condition.unit, remarks);
  }
  return remarks;
}

}  // namespace

std::vector<std::string> guesses_of(const StoredModel& stored, const std::string& path,
                                    const std::vector<Recording>& recordings) {
  std::vector<std::string> remarks = units_assumed(stored, path);
  append(remarks, impossible_laws(stored, path));
  append(remarks, drive_assumed(stored, path, recordings));
  append(remarks, beyond_laws(stored, path, recordings));
  return remarks;
}

std::vector<std::string> beyond_fitted(const StoredModel& stored, const std::string& path,
                                       const std::vector<Recording>& recordings) {
  const FittedOver& over = stored.fitted_over;
  std::vector<std::string> remarks;
  Farthest displacement;
  Farthest velocity;
  Farthest drive;
  const auto look = [](Farthest& farthest, const std::optional<std::pair<double, double>>& range,
                       const std::string& file, const std::vector<double>& values) {
    if (!range || values.empty()) return;
    const auto [low, high] = std::ranges::minmax(values);
    farthest.look(*range, file, low, high);
  };
  for (const Recording& recording : recordings) {
    look(displacement, over.displacement, recording.file, recording.displacement);
    // A made time has made speeds.
    if (recording.timed) look(velocity, over.velocity, recording.file, recording.velocity);
    if (over.drive && stored.drive == DriveKind::none && recording.drive_kind == over.drive_kind) {
      // Of a constant one, what it is.
      const double size = std::max(
          {over.drive->second - over.drive->first, std::fabs(over.drive->first), std::fabs(over.drive->second)});
      const auto [low, high] = std::ranges::minmax(recording.drive);
      drive.look(*over.drive, recording.file, low, high, size);
    }
  }
  displacement.tell_of_model(over.displacement.value_or(std::pair(0.0, 0.0)), path, "displacement", 1e3, "mm", remarks);
  velocity.tell_of_model(over.velocity.value_or(std::pair(0.0, 0.0)), path, "velocity", 1.0, "m/s", remarks);
  const bool voltage = over.drive_kind == DriveKind::voltage;
  drive.tell_of_model(over.drive.value_or(std::pair(0.0, 0.0)), path, voltage ? "voltage" : "current", 1.0,
                      voltage ? "V" : "A", remarks);
  return remarks;
}

std::vector<std::string> held_out_beyond_fitted(const nlohmann::json& model_file,
                                                const std::vector<Recording>& recordings,
                                                const std::vector<std::size_t>& held_out) {
  const std::string name = "the model";
  StoredModel stored = parse_model(model_file.dump(), name);
  follow_conditions(stored, recordings);
  const std::vector<Recording> judging = pick(recordings, held_out);
  std::vector<std::string> remarks = beyond_laws(stored, name, judging);
  append(remarks, beyond_fitted(stored, name, judging));
  return remarks;
}

std::vector<std::string> held_beyond_fitted(const StoredModel& stored, const std::string& path,
                                            const std::map<std::string, ConditionNumber>& at) {
  std::vector<std::string> remarks;
  for (const ConditionRange& condition : stored.conditions) {
    const auto held = at.find(condition.name);
    if (held == at.end() || !(condition.high > condition.low)) continue;
    const double value = held->second.value;
    const std::pair range(condition.low, condition.high);
    Farthest farthest;
    farthest.look(range, path, value, value);
    if (farthest.count == 0) continue;
    const std::string unit = condition.unit.empty() ? "" : " " + condition.unit;
    remarks.push_back(
        fmt::format("{}: held at a {} of {:.3g}{}, and its laws were fitted from {:.3g} to {:.3g}{}: what they say "
                    "beyond is a guess",
                    path, condition.name, value, unit, condition.low, condition.high, unit));
  }
  return remarks;
}

void refuse_excitation(const StoredModel& stored, const std::string& path, const std::vector<Recording>& recordings,
                       std::vector<std::string>& remarks) {
  if (!stored.from_response || recordings.empty()) return;
  for (const Recording& recording : recordings) {
    if (!stored.excited.contains(recording.sha256)) continue;
    throw InputError(recording.file + ": its force excites the mass whose motion " + path +
                     " was identified from, and is not the damper's; expected recordings of the damper's own force, in "
                     "files of their own "
                     "(fit.json has the errors of the motion, `respond` simulates it)");
  }
  remarks.push_back(
      fmt::format("{}: {} was identified from the motion of a mass: its errors say something only where "
                  "the force recorded is the damper's own, not what excites a mass{}",
                  recordings.front().file, path, alike(recordings.size())));
}

}  // namespace hysteron
