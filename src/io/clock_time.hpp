// Dates with times as files and campaign.toml write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hysteron {

// "2026-11-24T14:50:58", also with a space for the T, without seconds or with decimals of them, and with Z or an offset
// +01:00 behind; s since 1970-01-01T00:00 of the same clock, UTC with an offset. Nothing for any other text.
[[nodiscard]] std::optional<double> clock_time(std::string_view text);

// Whether a text that clock_time() reads, or a comment that clock_time_in() does, ends with Z or an offset.
[[nodiscard]] bool has_zone(std::string_view text);

// "2026-11-24T14:50:58", to the second.
[[nodiscard]] std::string clock_text(double seconds);

// "12:30:05 12-JAN-2020" and "12-Jan-2020 12:30:05", in s since 1970-01-01T00:00 of the same clock; nothing for any
// other text. The month is in letters: numbers leave in doubt which one is the day.
[[nodiscard]] std::optional<double> clock_time_with_month(std::string_view text);

// s since 1970 as a file stores them. Nothing before 1970, which a clock that was never set and a time of day without
// its date give, nor after the year 9999.
[[nodiscard]] std::optional<double> clock_time(double seconds);

// Whether a word stands before the time when a recording was started: start, started, start time, date, time, date and
// time, recorded.
[[nodiscard]] bool announces_start(std::string_view word);

// That of a comment line which says when a recording was started: "# start: 2026-11-24T14:50:58", or after another
// word that announces it.
[[nodiscard]] std::optional<double> clock_time_in(std::string_view comment);

// What such a line says that is a time of a day and is not read, as one whose day and month may be either: "24.11.2026
// 14:50:58"; nothing for any other line.
[[nodiscard]] std::optional<std::string_view> unread_start_in(std::string_view comment);

}  // namespace hysteron
