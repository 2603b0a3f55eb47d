// Channels of a measuring file, each with times of its own, and the recording they make.
//
// The times of a recording are those of the force channel (of the displacement where there is no force). A channel of
// other times is put on them: motions as smooth curves, drive and temperature by straight lines (io/resample.hpp). What
// lies outside of a motion's own times is left out; a drive and a temperature hold their first and last value for one
// of their own steps. A remark says which channels were put on the times of which. The recording was started with its
// first sample, where the channel of its times or the one they are taken from tells when that was.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Times start + k step, in s.
struct Clock {
  double start = 0.0;
  double step = 0.0;
  bool operator==(const Clock&) const = default;
};

struct MeasuredChannel {
  std::string group;  // or sheet; may be empty
  std::string name;   // units may stand behind it as in a CSV header
  std::string unit;   // as the file gives it; empty where it does not
  // That the file gives beside it.
  std::string other_unit = {};
  std::size_t count = 0;
  // The numbers, `count` of them, read when they are asked for; InputError where they cannot be.
  std::function<std::vector<double>()> values;
  std::optional<Clock> clock;        // refused, where no channel holds its times, with a step that is not above zero
  std::optional<std::size_t> times;  // the channel that holds its times
  std::optional<double> began;       // when its first value was measured, s since 1970
  std::optional<double> epoch;       // of one that holds times: when they are zero, s since 1970
};

// The channels of one file, or, where options.group is given, of one group. A channel named time serves those of its
// group that have as many values and none of their own, and goes before a clock. Everything wrong is an InputError.
[[nodiscard]] Recording recording_of(std::vector<MeasuredChannel> channels, const std::string& file,
                                     const ReadOptions& options);

}  // namespace hysteron
