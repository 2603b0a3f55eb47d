// Dates with times as files and campaign.toml write them: ISO 8601.
#pragma once

#include <optional>
#include <string_view>

namespace hysteron {

// "2026-11-24T14:50:58", also with a space for the T, without seconds or with decimals of them, and with Z or an offset
// +01:00 behind; s since 1970-01-01T00:00 of the same clock, UTC with an offset. Nothing for any other text.
[[nodiscard]] std::optional<double> clock_time(std::string_view text);

// That of a comment line which says when a recording was started: "# start: 2026-11-24T14:50:58", also after started,
// date, time, date and time, recorded.
[[nodiscard]] std::optional<double> clock_time_in(std::string_view comment);

}  // namespace hysteron
