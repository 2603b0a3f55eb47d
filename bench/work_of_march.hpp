// What a march of a law does: how often it evaluates the law's rates, and how much arithmetic the equations are.
#pragma once

#include <vector>

#include "simulate/motion.hpp"
#include "simulate/part.hpp"

namespace hysteron::bench {

struct WorkOfMarch {
  double rates = 0.0;               // evaluations of the law's rates, a sample
  double operations = 0.0;          // floating-point operations of equations and Runge-Kutta sums, a sample
  double operations_of_step = 0.0;  // the same if every sample were one step
};

// Of one candidate, whose parameters p are in the order of the card. An addition, a multiplication and a division are
// one operation each, elementary functions what scalar/math.hpp does for them, an fma two; comparisons, selections and
// signs none. Left out is what depends on parameters alone, and what a march does beside the equations: inputs between
// samples, bounds of the stiffness, and looks for kinks. Throws InputError where the equations cannot be written out.
WorkOfMarch work_of_march(const Part& law, const Motion& motion, const std::vector<double>& p);

}  // namespace hysteron::bench
