// Magnetic saturation as a law of the yield force in the drive.
#pragma once

#include <string>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// The effect that a yield force is which rises ever less with the drive, whichever parameter law shows it.
constexpr const char* saturation = "magnetic-saturation";

// Whether `parameter` is a yield force that follows the drive in the base model, and in the augmented one rises ever
// less with it: that is what magnetic saturation is, where the damping does not saturate with it.
bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter);

}  // namespace hysteron
