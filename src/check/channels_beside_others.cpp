#include "check/channels_beside_others.hpp"

#include <algorithm>
#include <string>

#include "io/channel_faults.hpp"
#include "io/clipped_ends.hpp"
#include "io/dead_force.hpp"

namespace hysteron {
namespace {

bool is_told_of(const Recording& recording, const Clipping& clipping) {
  return flat_end_of(recording.*clipping.channel).has_value();
}

}  // namespace

std::vector<Remark> remarks_on_channels_beside_others(const std::vector<Recording>& recordings) {
  std::vector<Remark> remarks;
  for (const Clipping& clipping : clipping_of(recordings)) {
    const std::vector<std::size_t>& at = clipping.ends.front().recordings;
    if (std::ranges::all_of(at, [&](std::size_t k) { return is_told_of(recordings[k], clipping); })) continue;
    const std::string channel = clipping.channel == &Recording::force ? "force" : "displacement";
    remarks.push_back({recordings[at.front()].file, Remark::Kind::implausible, "clipped " + channel,
                       sentence_of(clipping, recordings.size())});
  }
  for (const DeadForce& dead : dead_forces_of(recordings)) {
    remarks.push_back({recordings[dead.recording].file, Remark::Kind::implausible, "dead force", sentence_of(dead)});
  }
  return remarks;
}

}  // namespace hysteron
