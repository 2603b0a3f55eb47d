// Noise of the force channel, from the data alone.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// The upper one of the two in the middle; at least one value.
double median_of(std::vector<double> values);

struct NoiseFloor {
  double sigma = 0.0;  // N
  // "cycles": what differs between successive periods of a periodic motion; it holds coloured noise too.
  // "high-pass": robust fourth differences; only the part of the noise that is white is seen.
  std::string method;
  double white = 0.0;    // N, by high-pass, whatever the method
  double cycles = 0.0;   // periods in the motion, 0 when it is not periodic
  bool rounded = false;  // rounding to the quantum of the force is all that is seen
};

NoiseFloor noise_floor(const Recording& recording);

// The recording with as much noise again on its motion as displacement and velocity hold. How a model's force differs
// between the two is what the noise of the motion makes of it: no model can do better, and no force channel shows it.
Recording shaken(const Recording& recording);

// Period in s of a motion that repeats itself (displacement of successive periods equal within 3 % of its standard
// deviation), 0 when it does not or lasts less than 2.5 periods; and the time at which the running motion begins.
struct Periodicity {
  double period = 0.0;
  double begins = 0.0;
  double ends = 0.0;
};
Periodicity periodicity(const Recording& recording);

}  // namespace hysteron
