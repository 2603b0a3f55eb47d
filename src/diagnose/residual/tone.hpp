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
  std::size_t recordings = 0;  // that hold it: it is above what noise is expected to reach once
  std::size_t of = 0;          // recordings
};

// The strongest one that is not chance. At each frequency the power is compared with that of its own neighbourhood, so
// that noise may have any colour; of noise that ratio is exponential. What more than half of the recordings reach is
// the statistic, and how likely noise reaches it there, by the binomial distribution, decides. Where the predicted
// force has power of its own the motion may have made it. There must be two recordings. Frequencies below 15 cycles a
// recording are not looked at. results/tones.md has what it tells of tones put into recordings.
std::optional<Tone> tone_of(const std::vector<Leftover>& leftovers);

// cosine cos(2 pi frequency t) + sine sin(2 pi frequency t), in the unit of the residual; t is a recording's time, s.
struct Sine {
  double frequency = 0.0;  // Hz
  double cosine = 0.0;
  double sine = 0.0;

  [[nodiscard]] double at(double time) const;
};

// The sine by least squares within half a cycle over the recording of the frequency of a tone that other recordings
// show: this one may be too short to show it. Nothing where its motion may have made it.
std::optional<Sine> sine_of(const Leftover& leftover, double frequency);

}  // namespace hysteron
