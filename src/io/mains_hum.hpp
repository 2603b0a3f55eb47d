// The hum of the mains on a displacement, which its slope makes larger.
#pragma once

#include <optional>

#include "core/recording.hpp"

namespace hysteron {

// A tone at the frequency of the mains, alone among those around it and far above the motion, which the force does not
// follow as it follows the motion.
struct MainsHum {
  double frequency = 0.0;  // Hz
  double amplitude = 0.0;  // m
  double share = 0.0;      // of the velocity, RMS, where it is derived
};
// Nothing below a tenth of the velocity, or where the velocity was measured.
std::optional<MainsHum> mains_hum_of(const Recording& recording);

}  // namespace hysteron
