#include "task/dataset.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace hysteron {

std::string csv_of_simulated(const Recording& recording) {
  const std::pair<std::string_view, const std::vector<double>*> all[] = {
      {"time [s]", &recording.time},
      {"displacement [m]", &recording.displacement},
      {"velocity [m/s]", &recording.velocity},
      {"force [N]", &recording.force},
      {recording.drive_kind == DriveKind::voltage ? "voltage [V]" : "current [A]", &recording.drive}};
  std::string text;
  std::vector<const std::vector<double>*> columns;
  for (const auto& [name, channel] : all) {
    if (channel->empty()) continue;
    text += columns.empty() ? "" : ",";
    text += name;
    columns.push_back(channel);
  }
  text += '\n';
  for (std::size_t n = 0; n < recording.size(); ++n) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      text += k == 0 ? "" : ",";
      fmt::format_to(std::back_inserter(text), "{}", (*columns[k])[n]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace hysteron
