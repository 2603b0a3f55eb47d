// Where to look at a contrast: a recording, a stretch of it, and what to draw the force over.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/recording.hpp"
#include "diagnose/residual/contrast.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

enum class ForceOver { time, displacement, velocity };
std::string_view word_of(ForceOver over);

struct ContrastView {
  std::size_t recording = 0;  // index in the span that was given
  double from = 0.0;          // s
  double to = 0.0;
  ForceOver over = ForceOver::displacement;
};

// Of the recordings whose own value has the contrast's sign the one that the model without the effect misses most, and
// of it the stop, step, pause, cycle or whole course in which the contrast acts. Without a contrast (null): a cycle of
// the recording that is missed most, the force over the displacement. Empty where no recording has a motion that can be
// looked at.
std::optional<ContrastView> view_of(const Contrast* contrast, std::span<const Recording> recordings,
                                    std::span<const Residual> residuals);

}  // namespace hysteron
