#include "diagnose/signal/drive_levels.hpp"

#include "core/drive.hpp"

namespace hysteron {

std::size_t drive_levels(const std::vector<Recording>& recordings) {
  std::vector<double> values;
  for (const Recording& recording : recordings) {
    const std::vector<double> drive = quiet_condition(recording.drive);
    values.insert(values.end(), drive.begin(), drive.end());
  }
  return count_levels(std::move(values));
}

}  // namespace hysteron
