// How much of a change of force a re-fit of the law's parameters takes up, to first order.
#pragma once

#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

using Forces = std::vector<std::vector<double>>;  // recording by recording

// Derivatives of the force of a law without parts by its parameters (yield force and damping with their slopes over the
// drive, spring, offset, shape): one Forces a parameter. Shapes by differences, the others exactly.
[[nodiscard]] std::vector<Forces> law_derivatives(const Physics& physics, const std::vector<Run>& tests, double rate,
                                                  int decimation, const Forces& at_truth);

// What is left of `change` after the best combination of the derivatives; each recording is weighed by 1 / peak. With
// `single`, the combination is chosen anew for every recording.
[[nodiscard]] Forces left_over(const Forces& change, const std::vector<Forces>& derivatives,
                               const std::vector<double>& peaks, bool single);

}  // namespace hysteron::challenge
