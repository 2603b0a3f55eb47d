#include "core/recording.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/drive.hpp"

namespace hysteron {

std::vector<std::vector<double>*> channels_of(Recording& recording) {
  std::vector<std::vector<double>*> result = {
      &recording.time,  &recording.displacement, &recording.velocity,
      &recording.force, &recording.acceleration, &recording.derived_acceleration,
      &recording.drive, &recording.temperature,  &recording.base};
  for (ConditionChannel& condition : recording.conditions) {
    if (condition.values.size() > 1) {
      result.push_back(&condition.values);
    }
  }
  return result;
}

Recording every_kth(const Recording& recording, std::size_t k) {
  const auto kept = [k](const std::vector<double>& channel) {
    std::vector<double> result;
    result.reserve((channel.size() + k - 1) / k);
    for (std::size_t n = 0; n < channel.size(); n += k) {
      result.push_back(channel[n]);
    }
    return result;
  };
  // A member that is added and forgotten here does not compile.
  const auto& [file, sha256, time, displacement, velocity, force, acceleration, derived_acceleration, drive,
               temperature, base, unused, conditions, drive_kind, velocity_measured, started, earlier, timed, start] =
      recording;
  std::vector<ConditionChannel> kept_conditions;
  for (const ConditionChannel& condition : conditions) {
    kept_conditions.push_back({condition.name, condition.unit, kept(condition.values)});
  }
  return {file,
          sha256,
          kept(time),
          kept(displacement),
          kept(velocity),
          kept(force),
          kept(acceleration),
          kept(derived_acceleration),
          kept(drive),
          kept(temperature),
          kept(base),
          unused,
          std::move(kept_conditions),
          drive_kind,
          velocity_measured,
          started,
          earlier,
          timed,
          start};
}

std::vector<const Recording*> refer_to(const std::vector<Recording>& recordings) {
  std::vector<std::size_t> all(recordings.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return refer_to(recordings, all);
}

std::vector<const Recording*> refer_to(const std::vector<Recording>& recordings,
                                       const std::vector<std::size_t>& indices) {
  std::vector<const Recording*> result;
  result.reserve(indices.size());
  for (const std::size_t index : indices) {
    result.push_back(&recordings[index]);
  }
  return result;
}

std::vector<UnusedOfAll> unused_of_all(const std::vector<Recording>& recordings) {
  std::vector<UnusedOfAll> result;
  if (recordings.empty()) {
    return result;
  }
  const auto add = [&](const std::string& name, const auto& mean_of) {
    UnusedOfAll column{name, {}};
    for (const Recording& recording : recordings) {
      if (const std::optional<double> mean = mean_of(recording)) {
        column.means.push_back(*mean);
      }
    }
    if (column.means.size() == recordings.size()) {
      result.push_back(std::move(column));
    }
  };
  const auto follows = [&](const char* name) {
    return std::ranges::find(recordings.front().conditions, name, &ConditionChannel::name) !=
           recordings.front().conditions.end();
  };
  if (!follows("temperature"))
    add("temperature [degC]", [](const Recording& of) {
      return of.temperature.empty() ? std::nullopt
                                    : std::optional(std::accumulate(of.temperature.begin(), of.temperature.end(), 0.0) /
                                                    static_cast<double>(of.temperature.size()));
    });
  for (const UnusedColumn& column : recordings.front().unused) {
    add(column.name, [&](const Recording& of) {
      const auto own = std::ranges::find(of.unused, column.name, &UnusedColumn::name);
      return own == of.unused.end() ? std::nullopt : std::optional(own->mean);
    });
  }
  return result;
}

bool drive_varies(const Recording& recording) { return varies(recording.drive); }

std::size_t drive_levels(const std::vector<Recording>& recordings) {
  std::vector<double> values;
  for (const Recording& recording : recordings) {
    const std::vector<double> drive = quiet_condition(recording.drive);
    values.insert(values.end(), drive.begin(), drive.end());
  }
  return count_levels(std::move(values));
}

}  // namespace hysteron
