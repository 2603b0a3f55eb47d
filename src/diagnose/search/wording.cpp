#include "diagnose/search/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/unit_text.hpp"
#include "diagnose/search/relatives.hpp"
#include "simulate/part.hpp"

namespace hysteron {
namespace {

constexpr std::string_view current = "current";

// Without "e+05": 1.2e5.
std::string number_text(double value, int digits) {
  const int before = value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
  if (before > 6 || before < -3) {
    std::string text = fmt::format("{:.{}e}", value, digits - 1);
    const std::size_t at = text.find('e') + 1;
    const std::string exponent = std::to_string(std::stoi(text.substr(at)));
    return text.substr(0, at) + exponent;
  }
  return fmt::format("{:.{}f}", value, std::max(digits - before, 0));
}

}  // namespace

std::string worded(std::string_view text, DriveKind drive) {
  std::string chosen;
  bool inside = false;
  bool without = false;
  for (const char c : text) {
    if (c == '[' || c == ']') {
      inside = c == '[';
      without = false;
    } else if (inside && c == '|') {
      without = true;
    } else if (!inside || without == (drive == DriveKind::none)) {
      chosen += c;
    }
  }
  if (drive == DriveKind::voltage) {
    for (std::size_t at = chosen.find(current); at != std::string::npos; at = chosen.find(current, at)) {
      chosen.replace(at, current.size(), "voltage");
    }
  }
  return chosen;
}

DriveKind drive_kind_of(const std::vector<Recording>& recordings) {
  const auto driven = std::ranges::find_if(recordings, [](const Recording& one) { return !one.drive.empty(); });
  return driven == recordings.end() ? DriveKind::none : driven->drive_kind;
}

std::string title_of(std::string_view effect) {
  const std::string_view in_words = knowledge_of(effect).in_words;
  const Part* part = find_effect(effect);
  return std::string(!in_words.empty() ? in_words : part == nullptr ? effect : part->title);
}

std::string percent(double share) {
  constexpr double rounds_to_all = 0.995;
  return share >= rounds_to_all && share < 1.0 ? "over 99 %" : fmt::format("{:.0f} %", 100.0 * share);
}

std::string size_text(double value, const std::string& unit, int digits) {
  const double size = std::fabs(value);
  if (unit == "1" || unit.empty()) {
    return number_text(value, digits);
  }
  if ((unit == "m" || unit == "s") && size > 0.0 && size < 0.1) {
    return number_text(1e3 * value, digits) + (unit == "m" ? " mm" : " ms");
  }
  if (unit.starts_with("N") && size >= 1e4) {
    return size >= 1e7 ? number_text(1e-6 * value, digits) + " M" + unit_text(unit)
                       : number_text(1e-3 * value, digits) + " k" + unit_text(unit);
  }
  return number_text(value, digits) + " " + unit_text(unit);
}

}  // namespace hysteron
