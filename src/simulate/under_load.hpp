// Chains with series elements and states driven by the force, where the force is taken to be the measured one
// (Motion::load): no balance is solved. A series element of state q then deflects by D(q) with
//   q = F / hold,  or, where nothing holds it, q' = gain F,
// and the parts below see x - D, v - D'. Between two samples D is taken to be straight, so that the travel of the parts
// below adds up however steeply D bends there. Its error is D' times that of the measured force and of the model: a
// first look from which to start, a twentieth of the work of the balance (simulate/assembly.hpp).
#pragma once

#include <cstddef>

#include "simulate/composite.hpp"

namespace hysteron {

// As CompositeModel::march; the motion holds its load.
template <class T>
void march_under_load(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                      std::size_t begin, std::size_t end, T* state, T* out);

}  // namespace hysteron
