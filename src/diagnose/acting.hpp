// In which recordings an effect of a fit does something. A contrast is a sum over a recording, and one of an effect
// that acts in other recordings only may have its sign by chance: a stop that the motion does not reach is not seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/residual/contrast.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Of the fitted recordings, in their order: whether the force of the fit changes there where the effect is taken out
// and all else stays, at one sample at least by more than what two simulations may be apart: twice the error that the
// integration is allowed. All where the fit has it as a part of its law.
std::vector<bool> acting_in(const Workbench& bench, const Fit& fit, const std::string& effect);

// Recordings that show an effect.
struct Seen {
  std::size_t seen = 0;
  std::size_t of = 0;
};
// Those in which the effect acts and the contrast has the sign of its value, of all that it was taken of.
Seen seen_in(const Contrast& contrast, const std::vector<bool>& acting);

}  // namespace hysteron
