// Where no physics can be named, the augmented model still predicts: what it may add for that alone.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Effects and richer parameter laws added behind `fit` while each takes a plain part off the squared error of the
// fitted and of the judged recordings, at most so many. Of effects, the best of the step before.
// `effective` as in evidence(). Returns `fit` where nothing does.
Fit extended(const Workbench& bench, const Fit& fit, std::vector<std::string> effects, double effective, int most);

}  // namespace hysteron
