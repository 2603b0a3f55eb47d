#pragma once

#include <optional>
#include <vector>

#include "fit/layout.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Predicted force of one parameter set on a recording's motion.
std::vector<double> predict(const CompositeModel& model, const std::vector<double>& held,
                            const std::vector<Term>& terms, const Target& target);

// The time from which on the force of a recording is no longer finite.
[[nodiscard]] std::optional<double> diverges_at(const std::vector<double>& force, const Recording& recording);

}  // namespace hysteron
