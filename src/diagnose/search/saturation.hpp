// Magnetic saturation as a law of the yield force in the drive.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/stage.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

// The effect that a yield force is which rises ever less with the drive, whichever parameter law shows it.
constexpr const char* saturation = "magnetic-saturation";

// Whether `parameter` is a yield force that follows the drive in the base model and that saturates in the augmented
// one, which has no such effect: either it rises ever less with the drive, or behind the base model the effect takes
// off more than it leaves to richer laws. A polynomial that follows a knee is not concave everywhere.
bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter,
               const std::vector<Tried>& first_stage);

}  // namespace hysteron
