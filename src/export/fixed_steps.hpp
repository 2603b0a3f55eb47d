// The force of a model that takes always as many steps between two samples, as exported code does with --substeps.
#pragma once

#include <vector>

#include "export/exported.hpp"
#include "fit/target.hpp"

namespace hysteron {

// In exported.substeps steps up to a reversal and as many from it, where `simulate` takes as many as the stiffness asks
// for. One value a sample; not finite where so few steps are unstable.
std::vector<double> force_in_fixed_steps(const ExportedModel& exported, const Target& target);

}  // namespace hysteron
