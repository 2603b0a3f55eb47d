// What holds of every recording that a reader of measuring files takes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/format.hpp"
#include "target.hpp"

namespace hysteron::fuzz {

inline void check_recording(const Recording& recording) {
  for (const auto* channel : {&recording.time, &recording.displacement, &recording.velocity, &recording.force}) {
    require(channel->size() == recording.size(), "channels are of one length");
    require(std::ranges::all_of(*channel, [](double value) { return std::isfinite(value); }), "numbers are finite");
  }
  for (const auto* channel : {&recording.acceleration, &recording.drive, &recording.temperature}) {
    require(channel->empty() || channel->size() == recording.size(), "channels are of one length");
  }
  require(recording.size() >= fewest_rows, "there are enough samples");
  require(std::ranges::adjacent_find(recording.time, std::greater_equal<>()) == recording.time.end(), "time increases");
}

// Reads the bytes as a format does, as they are and with what options can ask for.
inline void read_as(std::string_view format, std::string_view bytes) {
  const auto found = std::ranges::find(formats(), format, &InputFormat::name);
  require(found != formats().end(), "the format is there");
  ReadOptions options;
  options.remark = [](const Remark& remark) { require(!remark.text.empty(), "a remark says something"); };
  Recording recording;
  if (taken([&] { recording = (*found)->parse(bytes, "input", options); })) check_recording(recording);
  ReadOptions mapped;
  mapped.group = "Test";
  mapped.columns = {{"time", "Test/Pressure [s]"}, {"force", "Load [kN]"}};
  mapped.keep_samples = 16;
  mapped.skip = 1;
  if (taken([&] { recording = (*found)->parse(bytes, "input", mapped); })) check_recording(recording);
}

}  // namespace hysteron::fuzz
