#include "fit/usable.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace hysteron {
namespace {

bool changes(const std::vector<double>& values) {
  return std::ranges::any_of(values, [&](double value) { return value != values.front(); });
}

}  // namespace

void require_usable(const std::vector<Recording>& recordings, ForceOf force) {
  for (const Recording& recording : recordings) {
    if (recording.size() < fewest_samples) {
      throw InputError(recording.file, 0,
                       std::to_string(recording.size()) + " samples, expected at least " +
                           std::to_string(fewest_samples) + " to identify a model from");
    }
    if (force == ForceOf::damper && changes(recording.displacement) && !changes(recording.force)) {
      throw InputError(recording.file, 0,
                       "the force is the same throughout, expected one that changes with the motion");
    }
  }
  if (std::ranges::none_of(recordings, [](const Recording& one) { return changes(one.displacement); })) {
    throw InputError(recordings.front().file, 0,
                     std::string("the displacement is the same throughout") +
                         (recordings.size() > 1 ? ", as in every other recording" : "") + ", expected a motion");
  }
}

void require_one_drive(const std::vector<Recording>& recordings) {
  const auto has_drive = [](const Recording& one) { return one.drive_kind != DriveKind::none; };
  const auto word = [](DriveKind kind) { return std::string(kind == DriveKind::voltage ? "voltage" : "current"); };
  const auto first = std::ranges::find_if(recordings, has_drive);
  if (first == recordings.end()) return;
  const std::string expected = word(first->drive_kind);
  for (const Recording& recording : recordings) {
    if (recording.drive_kind == first->drive_kind) continue;
    throw InputError(
        recording.file, 0,
        has_drive(recording)
            ? "records a " + word(recording.drive_kind) + ", expected a " + expected + " as in " + first->file
            : "no current or voltage, expected a " + expected + " as in " + first->file + ": a column, or a line " +
                  expected + " = NUMBER of the recording in campaign.toml");
  }
}

}  // namespace hysteron
