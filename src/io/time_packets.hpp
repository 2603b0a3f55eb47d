// Times of a logger that stamps whole packets of samples when they arrive, not each sample when it was taken.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/channels.hpp"

namespace hysteron {

// A longer step of time behind every `samples`, over which the displacement goes no further than over a step within a
// packet: the stamps are uneven, and the sampling is not. Where the longer steps are real the motion goes on during
// them, and there are no packets.
struct TimePackets {
  std::size_t samples = 0;
  double within = 0.0;   // s, usual step
  double between = 0.0;  // s, usual longer step
  double step = 0.0;     // s, of the even sampling: a packet over its samples
  bool even = false;     // no packet is further than half of its length from where even sampling puts it
};
std::optional<TimePackets> time_packets_of(const std::vector<double>& time, const std::vector<double>& displacement);

// Where the times come in packets, takes the samples as evenly spaced and tells `options.remark`; where they do so and
// samples are missing besides, tells of it alone.
void even_out_packets(Channels& channels, const ReadOptions& options, const std::string& file);

}  // namespace hysteron
