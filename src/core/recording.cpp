#include "core/recording.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/drive.hpp"

namespace hysteron {

std::array<std::vector<double>*, 8> channels_of(Recording& recording) {
  return {&recording.time,         &recording.displacement,         &recording.velocity, &recording.force,
          &recording.acceleration, &recording.derived_acceleration, &recording.drive,    &recording.temperature};
}

Recording every_kth(const Recording& recording, std::size_t k) {
  Recording result = recording;
  for (std::vector<double>* channel : channels_of(result)) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < channel->size(); n += k) {
      (*channel)[kept++] = (*channel)[n];
    }
    channel->resize(kept);
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

}  // namespace hysteron
