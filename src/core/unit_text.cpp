#include "core/unit_text.hpp"

namespace hysteron {

std::string term_unit(std::string_view unit, int drive_power, int frequency_power, DriveKind drive) {
  std::string result(unit);
  for (int k = 0; k < drive_power; ++k) result += drive == DriveKind::voltage ? "/V" : "/A";
  for (int k = 0; k < frequency_power; ++k) result += "/Hz";
  return result;
}

std::string unit_text(const std::string& unit) {
  const std::size_t at = unit.find_last_of('/');
  if (at == std::string::npos || at == 0 || (unit.substr(at) != "/A" && unit.substr(at) != "/V")) {
    return unit;
  }
  std::string head = unit;
  int power = 0;
  const std::string tail = unit.substr(at);
  while (head.ends_with(tail)) {
    head.resize(head.size() - tail.size());
    ++power;
  }
  return head + " " + tail.substr(1) + "^-" + std::to_string(power);
}

}  // namespace hysteron
