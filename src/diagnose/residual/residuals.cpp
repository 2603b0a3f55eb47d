#include "diagnose/residual/residuals.hpp"

#include <algorithm>

namespace hysteron {

double Residual::mean_square(std::size_t first) const {
  double sum = 0.0;
  for (std::size_t n = std::max(first, from); n < force.size(); ++n) {
    sum += force[n] * force[n];
  }
  return sum / static_cast<double>(force.size() - std::max(first, from));
}

}  // namespace hysteron
