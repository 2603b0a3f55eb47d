#include "io/clock_time.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <string>

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

}  // namespace

std::optional<double> clock_time(std::string_view text) {
  text = trimmed(text);
  const auto year = number(text, 4);
  if (!year || !take(text, "-")) return std::nullopt;
  const auto month = number(text, 2);
  if (!month || !take(text, "-")) return std::nullopt;
  const auto day = number(text, 2);
  if (!day || !take(text, "T ")) return std::nullopt;
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
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!text.empty() || !date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * *hour + 60.0 * *minute + second - offset;
}

std::optional<double> clock_time_in(std::string_view comment) {
  comment = trimmed(comment);
  if (!take(comment, "#")) return std::nullopt;
  const std::size_t colon = comment.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string word = lower_case(trimmed(comment.substr(0, colon)));
  constexpr std::array<std::string_view, 7> words = {"start", "started",       "start time", "date",
                                                     "time",  "date and time", "recorded"};
  return std::ranges::find(words, word) == words.end() ? std::nullopt : clock_time(comment.substr(colon + 1));
}

}  // namespace hysteron
