#include "core/recording.hpp"

#include <algorithm>

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

bool drive_varies(const Recording& recording) { return varies(recording.drive); }

}  // namespace hysteron
