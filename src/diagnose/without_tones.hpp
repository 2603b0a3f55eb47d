// Tones that run through the recordings whatever their motion (residual/tone.hpp), taken out of the forces: mains hum
// and machine noise hide effects that are smaller, and are none of the damper's.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/tone.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

struct WithoutTones {
  Campaign campaign;
  std::vector<Tone> tones;  // N, the strongest first; empty where there are none
};

// By what `fit` leaves of every recording.
WithoutTones without_tones(const Campaign& campaign, const Fit& fit, const Workbench& bench);

// "tones of 50 Hz (25 N) and 150 Hz (3.0 N), as of a machine, ..., were taken out of the force ...".
std::string sentence_of(const std::vector<Tone>& tones);

}  // namespace hysteron
