#include "core/unit_text.hpp"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace hysteron {
namespace {
constexpr int highest_power = 99;  // one that is higher is none
}

std::string term_unit(std::string_view unit, int drive_power, int frequency_power, DriveKind drive) {
  std::string result(unit);
  for (int k = 0; k < drive_power; ++k) result += drive == DriveKind::voltage ? "/V" : "/A";
  for (int k = 0; k < frequency_power; ++k) result += "/Hz";
  return result;
}

std::string unit_over(std::string_view unit, std::string_view by, int power) {
  std::string result(unit);
  const bool one_symbol = by.find_first_of("/ *") == std::string_view::npos;
  for (int k = 0; k < power && !by.empty(); ++k) {
    result += one_symbol ? "/" + std::string(by) : "/(" + std::string(by) + ")";
  }
  return result;
}

std::string unit_text(const std::string& unit) {
  // Of laws in the drive or the frequency, or divided more than once, as a law in a column is: "N s/m/degC/degC".
  const bool divided_again = std::ranges::count(unit, '/') > 1 && unit.find_first_of("()") == std::string::npos;
  if (!divided_again && !unit.ends_with("/A") && !unit.ends_with("/V") && !unit.ends_with("/Hz")) {
    return unit;
  }
  // Behind a bracket what is divided by is a whole: "m/(N s)/A".
  const std::size_t bracket = unit.find(')');
  const std::size_t begin = unit.find('/', bracket == std::string::npos ? 0 : bracket);
  const std::string head = unit.substr(0, begin);
  std::vector<std::pair<std::string, int>> below;
  for (std::size_t at = begin; at < unit.size();) {
    const std::size_t end = std::min(unit.find('/', at + 1), unit.size());
    const std::string part = unit.substr(at + 1, end - at - 1);
    const std::size_t caret = part.find('^');
    const std::string symbol = part.substr(0, caret);
    int power = 1;
    if (caret != std::string::npos) {
      const char* const last = part.data() + part.size();
      const auto read = std::from_chars(part.data() + caret + 1, last, power);
      if (read.ec != std::errc{} || read.ptr != last || power < 1 || power > highest_power) return unit;
    }
    const auto known = std::ranges::find(below, symbol, &std::pair<std::string, int>::first);
    if (known == below.end()) {
      below.emplace_back(symbol, power);
    } else {
      known->second += power;
    }
    at = end;
  }
  std::string result = head == "1" ? "" : head;
  for (const auto& [symbol, power] : below) {
    result += (result.empty() ? "" : " ") + symbol + "^-" + std::to_string(power);
  }
  return result;
}

std::string per_text(std::string_view unit, std::string_view condition, int power) {
  std::string result = unit.empty() ? "unit of " + std::string(condition) : unit == "degC" ? "°C" : std::string(unit);
  if (power == 1) return result;
  if (result.find_first_of("/ *") != std::string::npos) result = "(" + result + ")";
  return result + "^" + std::to_string(power);
}

}  // namespace hysteron
