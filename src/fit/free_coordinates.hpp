// Which coordinates of a point are off the bounds of the unit box.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hysteron {

// A descent that ends on a bound ends there exactly, up to the rounding of its steps.
inline bool on_bound(double u) { return u <= 1e-6 || u >= 1.0 - 1e-6; }

inline std::vector<Eigen::Index> free_coordinates(const std::vector<double>& u) {
  std::vector<Eigen::Index> result;
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (!on_bound(u[k])) result.push_back(static_cast<Eigen::Index>(k));
  }
  return result;
}

}  // namespace hysteron
