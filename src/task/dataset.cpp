#include "task/dataset.hpp"

#include <fmt/format.h>

namespace hysteron {

std::string csv_of_simulated(const Recording& recording) {
  std::string text = "time [s],displacement [m],velocity [m/s],force [N],";
  text += recording.drive_kind == DriveKind::voltage ? "voltage [V]\n" : "current [A]\n";
  for (std::size_t n = 0; n < recording.size(); ++n) {
    text += fmt::format("{},{},{},{},{}\n", recording.time[n], recording.displacement[n], recording.velocity[n],
                        recording.force[n], recording.drive[n]);
  }
  return text;
}

}  // namespace hysteron
