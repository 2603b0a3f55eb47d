// Moments in which the displacement holds one value although the rod goes on.
//
// A channel that is frozen from the sample a to the sample b has its next sample where the motion has gone meanwhile:
//
//   x[a] = ... = x[b],   x[b+1] - x[a] = (v0 + v1) / 2 (t[b+1] - t[a])
//
// with v0 and v1 the speeds before a and behind b + 1, of one sign. A rod that rests begins again from where it is, by
// no longer step than the next ones. Where the motion turned round meanwhile the two speeds tell no way, and a dwell at
// the end of a stroke looks the same: nothing is told of these. A longer stretch, over which the force rises and falls:
// frozen_stretch_of() (io/channel_faults.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/recording.hpp"

namespace hysteron {

struct FrozenMoments {
  std::size_t first = 0;  // index of a sample, of the one with the longest jump behind it
  std::size_t last = 0;
  std::size_t count = 0;     // of the moments
  bool force_holds = false;  // as well, in all of them: rows that were repeated
};
std::optional<FrozenMoments> frozen_moments_of(const Recording& recording);

// "the displacement stays at exactly 3.21 mm from ...", without a full stop.
std::string sentence_of(const FrozenMoments& frozen, const Recording& recording);

}  // namespace hysteron
