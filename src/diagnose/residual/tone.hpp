// A tone in what is left that every recording holds at one frequency, whatever its motion: of the machine, the mains or
// a sensor. Where cycles of the motion are compared it counts as noise; that its spectrum is a line tells it from
// noise.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/residual/leftover.hpp"

namespace hysteron {

struct Tone {
  double frequency = 0.0;      // Hz
  double amplitude = 0.0;      // root mean square over the recordings of its amplitude, in the unit of the residual
  double share = 0.0;          // of the squared residual
  std::size_t recordings = 0;  // in which it stands out
  std::size_t of = 0;          // recordings
};

// The strongest one that is not chance: spectra are compared with their own neighbourhood, so that noise may have any
// colour, and frequencies at which the predicted force has a line of its own are the motion's. Recordings of 64 samples
// or more count, and there must be three of them. Frequencies below 15 cycles a recording are not looked at.
std::optional<Tone> tone_of(const std::vector<Leftover>& leftovers);

}  // namespace hysteron
