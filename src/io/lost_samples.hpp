// Rows that were lost before the others were given even times.
//
// Where m rows are lost between two samples the motion goes on by m + 1 of its steps from the one to the next:
//
//   x[n+1] - x[n] = (1 + r[n]) s[n],   r[n] = m
//
// with s[n] the step that the neighbours tell: the mean of the middle two of the two steps before and the two behind.
// Noise, jitter of the sampling and a sample that comes late make one step longer and another one shorter, by any part;
// a lost row makes one longer alone, and by a whole step, whatever the speed. Where the rows kept the times at which
// they were taken the times are longer as well, and nothing is wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/recording.hpp"

namespace hysteron {

struct LostSamples {
  std::size_t after = 0;  // the first are lost between this sample and the next
  std::size_t count = 0;  // of the places where some are
  double share = 0.0;     // of all that were taken, by the samples that are fast enough to tell
};
// Nothing in fewer than three places, and where a quarter as many steps are off by anything else.
std::optional<LostSamples> lost_samples_of(const Recording& recording);

// "the displacement goes by two of its steps at once ...", without a full stop.
std::string sentence_of(const LostSamples& lost, const Recording& recording);

}  // namespace hysteron
