// A simulation that does not stay finite is a failure, told as one.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "fit/predict.hpp"

namespace hysteron {

// WorkError naming the recording and the time where a force is not finite.
void require_finite(const std::vector<double>& force, const Recording& recording);

// "98.7", or "-" where there is none: the fit in percent of a force that does not change.
[[nodiscard]] std::string percent_text(double percent);

}  // namespace hysteron
