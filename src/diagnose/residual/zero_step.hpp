// A zero of the force that steps in the course of a recording, as of a load cell that is zeroed while the test runs. It
// repeats with nothing of the motion, so that cycles count it as noise, and effects that change slowly explain half of
// it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

struct ZeroStep {
  double time = 0.0;   // s since the start of the recording
  double step = 0.0;   // N, of the measured force
  double share = 0.0;  // of the squared residual about its mean
};

// The step that explains most of what is left of a recording; nothing where a slow course explains as much, or the
// motion or its drive is another behind it. `residual` as in Residual.
std::optional<ZeroStep> zero_step_of(const Recording& recording, const Residual& residual);

// The largest of several recordings.
struct ZeroSteps {
  ZeroStep largest;
  std::string file;      // that has it
  std::size_t with = 0;  // recordings that have one
  std::size_t of = 0;
};
// Nothing where no recording has one.
std::optional<ZeroSteps> zero_steps_of(const std::vector<Recording>& recordings,
                                       const std::vector<Residual>& residuals);
// "the zero of the force steps by 30 N at 3.12 s of r1.csv (7 of 8 recordings have such a step) ...", without a full
// stop.
std::string sentence_of(const ZeroSteps& steps);
// Whether most recordings have one: a name would be given to it.
bool shape_the_search(const ZeroSteps& steps);

}  // namespace hysteron
