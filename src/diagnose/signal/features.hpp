// What a misfit may be locked to, sample by sample: displacement, velocity, the last reversal, the last change of the
// drive, the place in the recording.
#pragma once

#include <vector>

#include "core/recording.hpp"

namespace hysteron {

struct Features {
  std::vector<double> since_reversal_distance;  // m travelled since the velocity last changed sign
  std::vector<double> since_reversal_time;      // s
  std::vector<double> since_drive_change;  // s since the drive last moved by 5 % of its range; empty if it never does
  std::vector<double> drive_step;          // last such change, A or V, signed; empty likewise
  std::vector<double> travelled;           // m since the start of the recording
  double stroke = 0.0;                     // half of the displacement's range, m
  double centre = 0.0;                     // middle of the displacement's range, m
  double speed = 0.0;                      // largest |velocity|, m/s
};

Features features_of(const Recording& recording);

}  // namespace hysteron
