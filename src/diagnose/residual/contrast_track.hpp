// A recording beside the force that the base model has on its motion, as the contrasts look at it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron::contrast {

using Values = std::vector<double>;

// Samples [first, end).
struct Stretch {
  std::size_t first = 0;
  std::size_t end = 0;
};

// A stop of the motion and the rest that follows.
struct Hold {
  Stretch samples;
  double direction = 0.0;  // of the motion before: 1 or -1, 0 for the rest at the start of a recording
};

// All samples of a recording, from its first on; those before `from` do not count.
struct Track {
  std::size_t recording = 0;
  std::size_t motion = 0;  // number of its motion (conditions.hpp)
  std::size_t from = 0;
  double weight = 0.0;  // 1 / (N^2 s): of a squared force times a duration, so that each recording weighs the same
  double peak = 0.0;    // largest simulated |force|, N
  double speed = 0.0;   // largest |velocity|, m/s
  double stroke = 0.0;  // half of the range of the displacement, m
  double period = 0.0;  // s, twice the median time between reversals; 0 where there are fewer than two
  Values time, x, v, a, drive;
  Values force;        // measured, N
  Values simulated;    // of the base model, N
  Values missing;      // measured - simulated, N
  Values slope;        // of the simulated force, N/s
  Values stiff;        // the same per distance travelled, N/m, but for jumps of the drive; bounded at reversals
  Values since;        // m travelled since the reversal
  Values at_reversal;  // simulated force at the reversal, N
  Values direction;    // 1 or -1, 0 before the first motion
  Values travelled;    // m since the first sample
  std::vector<EarlierWork> earlier;  // of the recording
  Values work;                       // J done on the damper since the first sample
  Values slip;      // recorded velocity less the slope of the displacement, m/s; empty unless the velocity was recorded
  Values duration;  // s that a sample stands for
  std::vector<std::size_t> half_cycle;  // number of the reversal before
  std::vector<Stretch> half_cycles;     // from reversal to reversal, within what counts
  std::vector<Hold> holds;              // within what counts
};

// Recordings of too few samples, or without motion or force, or whose residual is not finite, have none. Where no
// motions are given each recording has one of its own.
std::vector<Track> tracks_of(std::span<const Recording> recordings, std::span<const Residual> residuals,
                             std::span<const std::size_t> motions = {});

}  // namespace hysteron::contrast
