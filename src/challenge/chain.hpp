// The measuring chain: delay, filter, sampling, noise, outliers, quantisation.
#pragma once

#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

// Shares are of the campaign's peak force, amplitude and speed.
struct Chain {
  double noise = 0.005;         // standard deviation of the force noise
  double coloured_share = 0.3;  // of its variance, as AR(1)
  double correlation = 0.8;     // of neighbouring samples of the coloured part
  double outlier_rate = 0.0;    // of the samples
  double outlier_size = 0.05;
  int force_bits = 14;  // over 2.5 peaks
  double displacement_noise = 1e-4;
  int displacement_bits = 16;
  double velocity_noise = 1e-3;
  double drive_noise = 1e-3;  // of the highest level
};

struct Measured {
  std::vector<double> time, x, v, drive, force;
  std::vector<double> clean;  // the filtered force without noise, outliers and quantisation
};

struct Range {
  double force = 1.0, amplitude = 1.0, speed = 1.0, level = 1.0;
};

// The force as the load cell and the filter see it at the sampling instants, without noise. `decimation` grid points
// make a sample.
[[nodiscard]] std::vector<double> clean_force(const Physics& physics, const Track& track, int decimation);

[[nodiscard]] Measured measure(const Physics& physics, const Track& track, int decimation, const Chain& chain,
                               const Range& range, const Stream& stream);

}  // namespace hysteron::challenge
