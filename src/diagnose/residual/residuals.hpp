// What a fit leaves of the fitted recordings: simulated once (Workbench::residuals) and handed around.
#pragma once

#include <cstddef>
#include <vector>

#include "core/squared.hpp"
#include "diagnose/signal/noise.hpp"

namespace hysteron {

// Simulated - measured force in N at every sample; those before `from`, the run-in, are zero and do not count.
struct Residual {
  std::vector<double> force;
  std::size_t from = 0;

  // Mean square over the samples from `first` on that count.
  [[nodiscard]] double mean_square(std::size_t first = 0) const;
};

// Of several recordings; arrays of their number and in their order.
struct Residuals {
  std::vector<Residual> of;
  std::vector<double> norms;      // N, what the force of each is divided by
  std::vector<NoiseFloor> noise;  // of the force of each, by itself
  std::vector<double>
      passed_on;  // N^2, mean square of what the noise of the recorded motion makes of the model's force
};

}  // namespace hysteron
