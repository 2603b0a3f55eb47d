// Where a channel ends because its sensor or amplifier does, seen beside other recordings, whatever noise is on it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// A level that a channel comes to rest at again and again in several recordings, to within a part of its noise, while
// the rod goes on, and that none goes beyond.
struct ClippedEnd {
  double level = 0.0;                   // N or m
  std::vector<std::size_t> recordings;  // that rest at it
  double share = 0.0;                   // of the samples, of the recording that rests at it longest
};

// The ends of one channel. A damper that yields rests at a level too, which differs with its drive, or is the same in
// all recordings and left where the rod turns round; a force that cavitation limits in one direction is followed by
// travel without force. Where the noise of the force ends with it (io/saturation.hpp) one recording tells by itself. At
// an end of the displacement the force turns round meanwhile, which it does not over a rod
// that rests.
struct Clipping {
  std::vector<double> Recording::*channel = nullptr;
  std::vector<ClippedEnd> ends;
};
std::vector<Clipping> clipping_of(const std::vector<Recording>& recordings);
// "the force rests at 620 and -620 N, the ends of its range, in 3 of 8 recordings ...", without a full stop.
std::string sentence_of(const Clipping& clipping, std::size_t recordings);

}  // namespace hysteron
