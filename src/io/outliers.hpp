// Samples of a channel that stand out alone: of the recording chain, not of the damper.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

struct Outlier {
  std::size_t at = 0;    // index of the sample
  double told = 0.0;     // what its neighbours say
  bool extreme = false;  // further from that than the channel spans without its outliers
};

// Samples that lie far from what their four neighbours say (cubic interpolation, as of even spacing), where these agree
// among each other; two that hide each other, one or two samples apart; and one or two side by side, at an end of the
// recording too, that are further from the median of the five samples about them than that median ever spans. A step, a
// kink and any other peak of several samples are no outliers. Where more than one sample of fifty would be one, none
// is: that is how the channel is.
[[nodiscard]] std::vector<Outlier> outliers_of(std::span<const double> time, std::span<const double> values);

// One or two samples side by side of a channel that is set to a level, or to several, far from the median of the five
// samples about them: further than that median ever spans, than half of its largest size, and than the noise. A channel
// that is set to zero throughout has no measure of far.
[[nodiscard]] std::vector<Outlier> outliers_of_setting(const std::vector<double>& values);

// Replaces the outliers of the force by what their neighbours say; their number.
std::size_t replace_outliers(Recording& recording);

}  // namespace hysteron
