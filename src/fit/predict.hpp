#pragma once

#include <vector>

#include "fit/layout.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Predicted force of one parameter set on a recording's motion.
std::vector<double> predict(const CompositeModel& model, const std::vector<double>& held,
                            const std::vector<Term>& terms, const Target& target);

}  // namespace hysteron
