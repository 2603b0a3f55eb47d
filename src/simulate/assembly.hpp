// Chains in which a part needs the force of the parts below it: series elements, behind which the parts below are
// deflected, and states driven by the force. The motion that a part sees then is no longer the recorded one, and
// neither is the stiffness, so the step follows the state.
//
// The balance of forces is solved at every stage (balance.hpp); u = q' is the rate of an element's state.
//
// The rate of the element's state falls with q as
//   lambda = gain (hold + D' K) / (1 + gain D' dF/dv), and while D bends by gain |D'' u| dF/dv / (1 + ...) more,
// K being the instantaneous stiffness of the links below: the slope of their force when they are moved with their
// states following. K and dF/dv are probed at the start of every step, K in both directions of motion. Where lambda
// would pass the motion's element_rate_limit the element is slowed down by a smaller gain, which is more damping of its
// own.
#pragma once

#include <cstddef>

#include "simulate/composite.hpp"
#include "simulate/part.hpp"

namespace hysteron {

// As CompositeModel::march.
template <class T>
void march_assembly(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                    std::size_t begin, std::size_t end, T* state, T* out);

}  // namespace hysteron
