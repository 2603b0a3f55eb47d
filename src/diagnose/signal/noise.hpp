// Noise of the force channel, from the data alone.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

enum class NoiseMethod {
  unknown,    // too few samples
  cycles,     // what differs between successive periods of a motion that repeats; it holds coloured noise too
  high_pass,  // robust fourth differences; only the part of the noise that is white is seen
  mixed       // of several recordings: cycles where the motion repeats, high-pass elsewhere
};
std::string_view word_of(NoiseMethod method);

// Samples of a recording from which its noise can be told at all.
constexpr std::size_t fewest_noise_samples = 16;

struct NoiseFloor {
  double sigma = 0.0;  // N
  NoiseMethod method = NoiseMethod::unknown;
  double white = 0.0;    // N, by high-pass, whatever the method
  double cycles = 0.0;   // periods that were compared, 0 where none are
  bool rounded = false;  // rounding to the quantum of the force is all that is seen
};

// By cycles where a stretch of the motion repeats itself (periodicity), else by high-pass. Of what differs between
// successive periods, that part is no noise which follows a force that fades or grows over the periods, a drift of its
// zero, or what displacement and velocity themselves differ by: it is taken off, as far as it is linear. A fade
// changes from one period to the next by far less than over all of them.
NoiseFloor noise_floor(const Recording& recording);

// The recording with as much noise again on its motion as displacement and velocity hold. How a model's force differs
// between the two is what the noise of the motion makes of it: no model can do better, and no force channel shows it.
Recording shaken(const Recording& recording);

// The longest stretch of a recording that repeats itself from period to period: displacement of successive periods
// equal within 3 % of its standard deviation there, and so the drive where it varies. The first half period of it is
// left out (the force still knows what came before), after which at least two periods stay. Ramps, rests and other
// amplitudes bound it; what repeats with another period than the one of most half cycles is not found. All zero where
// nothing repeats.
struct Periodicity {
  double period = 0.0;  // s
  double begins = 0.0;  // s, of the recording's time
  double ends = 0.0;
};
Periodicity periodicity(const Recording& recording);

}  // namespace hysteron
