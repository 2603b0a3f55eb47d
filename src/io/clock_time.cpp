#include "io/clock_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "io/text.hpp"

namespace hysteron {
namespace {

// Takes `digits` digits off the front.
std::optional<int> number(std::string_view& text, std::size_t digits) {
  int value = 0;
  if (text.size() < digits) return std::nullopt;
  const auto read = std::from_chars(text.data(), text.data() + digits, value);
  if (read.ec != std::errc{} || read.ptr != text.data() + digits || text.front() == '-') return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, std::string_view one_of) {
  if (text.empty() || one_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

// Two digits each of hours and minutes, and of seconds where they follow, also with decimals; s since midnight.
std::optional<double> time_of_day(std::string_view& text) {
  const auto hour = number(text, 2);
  if (!hour || !take(text, ":")) return std::nullopt;
  const auto minute = number(text, 2);
  if (!minute || *hour > 24 || *minute > 59) return std::nullopt;
  double second = 0.0;
  if (take(text, ":")) {
    const auto whole = number(text, 2);
    if (!whole || *whole > 60) return std::nullopt;
    second = *whole;
    double place = 0.1;
    if (take(text, ".,")) {
      for (; !text.empty() && text.front() >= '0' && text.front() <= '9'; text.remove_prefix(1), place *= 0.1) {
        second += place * (text.front() - '0');
      }
    }
  }
  return 3600.0 * *hour + 60.0 * *minute + second;
}

// s since 1970 at its midnight; nothing where there is no such day.
std::optional<double> start_of_day(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

// "12-Jan-2020"
std::optional<double> date_with_month(std::string_view text) {
  constexpr std::array<std::string_view, 12> months = {"jan", "feb", "mar", "apr", "may", "jun",
                                                       "jul", "aug", "sep", "oct", "nov", "dec"};
  const auto day = number(text, text.find('-') == 1 ? 1 : 2);
  if (!day || !take(text, "-")) return std::nullopt;
  const auto month = std::ranges::find(months, lower_case(text.substr(0, 3)));
  if (month == months.end()) return std::nullopt;
  text.remove_prefix(3);
  if (!take(text, "-")) return std::nullopt;
  const auto year = number(text, 4);
  if (!year || !text.empty()) return std::nullopt;
  return start_of_day(*year, static_cast<int>(month - months.begin()) + 1, *day);
}

}  // namespace

std::optional<double> clock_time(std::string_view text) {
  text = trimmed(text);
  const auto year = number(text, 4);
  if (!year || !take(text, "-")) return std::nullopt;
  const auto month = number(text, 2);
  if (!month || !take(text, "-")) return std::nullopt;
  const auto day = number(text, 2);
  if (!day || !take(text, "T ")) return std::nullopt;
  const auto time = time_of_day(text);
  if (!time) return std::nullopt;
  double offset = 0.0;
  if (!text.empty() && !take(text, "Z")) {
    const double sign = text.front() == '-' ? -1.0 : 1.0;
    if (!take(text, "+-")) return std::nullopt;
    const auto hours = number(text, 2);
    take(text, ":");
    const auto minutes = number(text, 2);
    if (!hours || !minutes || *hours > 15 || *minutes > 59) return std::nullopt;
    offset = sign * (3600.0 * *hours + 60.0 * *minutes);
  }
  const auto date = start_of_day(*year, *month, *day);
  if (!text.empty() || !date) return std::nullopt;
  return *date + *time - offset;
}

bool has_zone(std::string_view text) {
  text = trimmed(text);
  if (text.ends_with('Z')) return true;
  const std::size_t sign = text.find_last_of("+-");
  if (sign == std::string_view::npos) return false;
  // A date has more behind its last hyphen.
  const std::string_view offset = text.substr(sign + 1);
  return offset.size() >= 4 && offset.size() <= 5 && offset.find_first_not_of("0123456789:") == std::string_view::npos;
}

std::string clock_text(double seconds) {
  const std::chrono::sys_seconds moment{std::chrono::seconds(static_cast<std::int64_t>(std::floor(seconds)))};
  const auto day = std::chrono::floor<std::chrono::days>(moment);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(moment - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), time.hours().count(),
                     time.minutes().count(), time.seconds().count());
}

std::optional<double> clock_time_with_month(std::string_view text) {
  text = trimmed(text);
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  std::string_view time = text.substr(0, space);
  std::string_view date = trimmed(text.substr(space));
  if (time.find(':') == std::string_view::npos) std::swap(time, date);
  const auto midnight = date_with_month(date);
  const auto since_midnight = time_of_day(time);
  if (!midnight || !since_midnight || !time.empty()) return std::nullopt;
  return *midnight + *since_midnight;
}

std::optional<double> clock_time(double seconds) {
  constexpr double end_of_9999 = 253'402'300'800.0;
  return seconds >= 0.0 && seconds < end_of_9999 ? std::optional(seconds) : std::nullopt;
}

bool announces_start(std::string_view word) {
  constexpr std::array<std::string_view, 7> words = {"start", "started",       "start time", "date",
                                                     "time",  "date and time", "recorded"};
  return std::ranges::find(words, lower_case(trimmed(word))) != words.end();
}

namespace {

// What a comment line says after a word that announces a start.
std::optional<std::string_view> announced_in(std::string_view comment) {
  comment = trimmed(comment);
  if (!take(comment, "#")) return std::nullopt;
  const std::size_t colon = comment.find(':');
  if (colon == std::string_view::npos || !announces_start(comment.substr(0, colon))) return std::nullopt;
  return trimmed(comment.substr(colon + 1));
}

}  // namespace

std::optional<double> clock_time_in(std::string_view comment) {
  const auto said = announced_in(comment);
  return said ? clock_time(*said) : std::nullopt;
}

std::optional<std::string_view> unread_start_in(std::string_view comment) {
  const auto said = announced_in(comment);
  const bool time_of_day =
      said && said->find(':') != std::string_view::npos && said->find_first_of("0123456789") != std::string_view::npos;
  return time_of_day && !clock_time(*said) ? said : std::nullopt;
}

}  // namespace hysteron
