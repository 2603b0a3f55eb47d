// Marches of chains with series elements for comparing hypotheses: in steps that need not follow the elements, however
// stiff these are.
//
// The states q of the elements take the two stages of the diagonally implicit Runge-Kutta method of order two that is
// L-stable, g = 1 - 1 / sqrt(2) (Alexander, SIAM J. Numer. Anal. 14 (1977) 1006-1021, doi 10.1137/0714068):
//   q_1 = q_0 + g h u_1,     q_2 = q_0 + h ((1 - g) u_1 + g u_2),     u_i = gain (F_i - hold q_i)
// All other states take a step of the classical Runge-Kutta method to t_1 = t_0 + g h and one on to t_2 = t_0 + h,
// along a motion from which the elements take a deflection that is linear in time in between. F_i is the force of the
// links below with the states so reached, at
//   x(t_i) - D(q_i),     v(t_i) - (D(q_i) - D(q_i - g h u_i)) / (g h)
// which is v - D' u where D is straight, and falls with u also where D bends: u_i - gain (F_i - hold q_i) rises with
// u_i by more than one to one for every law whose force does not fall with displacement and velocity, and has one root.
#pragma once

#include <cstddef>

#include "simulate/composite.hpp"

namespace hysteron {

// States of a part that the steps have room for.
inline constexpr int most_states_of_a_link = 4;

// Whether the chain holds a series element, and no part with more states.
[[nodiscard]] bool takes_implicit_steps(const CompositeModel& model);

// As CompositeModel::march, of a chain that takes such steps.
template <class T>
void march_implicit(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                    std::size_t begin, std::size_t end, T* state, T* out);

}  // namespace hysteron
