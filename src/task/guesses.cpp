#include "task/guesses.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/layout.hpp"

namespace hysteron {
namespace {

constexpr double far_beyond = 0.1;  // of what laws were fitted over

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
    const double below = range.first - low;
    const double above = high - range.second;
    const double out = std::max(below, above);
    if (!(out > far_beyond * (range.second - range.first))) return;
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
};

}  // namespace

std::vector<std::string> guesses_of(const StoredModel& stored, const std::string& path,
                                    const std::vector<Recording>& recordings) {
  std::vector<std::string> remarks;
  const bool voltage = stored.drive == DriveKind::voltage;
  const char* const drive_word = voltage ? "voltage" : "current";
  std::string without;
  std::size_t count_without = 0;
  Farthest drive;
  Farthest frequency;
  for (const Recording& recording : recordings) {
    if (stored.drive != DriveKind::none && recording.drive.empty()) {
      if (count_without++ == 0) without = recording.file;
    } else if (stored.drive_range && recording.drive_kind == stored.drive) {
      const auto [low, high] = std::ranges::minmax(recording.drive);
      drive.look(*stored.drive_range, recording.file, low, high);
    }
    if (stored.frequency_range) {
      const double hertz = dominant_frequency(recording);
      frequency.look(*stored.frequency_range, recording.file, hertz, hertz);
    }
  }
  if (count_without > 0) {
    remarks.push_back(fmt::format("{}: no {} column, and parameters of {} follow the {}: taken as zero{}", without,
                                  drive_word, path, drive_word, alike(count_without)));
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

}  // namespace hysteron
