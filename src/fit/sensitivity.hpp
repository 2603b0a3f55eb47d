// How much each parameter changes what is simulated.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/layout.hpp"
#include "fit/solver.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Scaled sensitivity of a parameter: rms of p dF/dp over the rms of the measured force F, over all samples as the cost
// weighs them. At 0.5 a parameter that is 1 % larger changes the force by 0.5 % of its rms. Of a parameter with a law p
// is what the law gives at each sample, so that the whole law is scaled.
struct ScaledSensitivity {
  std::size_t parameter;
  double value;  // not finite where the derivative is not
};

// Of every searched parameter, the most influential first. `derivatives` of one point u, whose first coordinates are
// the layout's; `measured`: mean square of what is measured, in the units of cost^2.
std::vector<ScaledSensitivity> sensitivities(const Layout& layout, const Response& derivatives, double measured,
                                             const std::vector<double>& u);

// Mean square of the measured force, in the units of cost^2.
double measured_square(const std::vector<Target>& targets);

}  // namespace hysteron
