// Which parameters the data fix together only.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/solver.hpp"

namespace hysteron {

// From this |r| on the data do not separate two parameters: the standard error of each would be ten times smaller,
// 1 / sqrt(1 - r^2), if the other were known. With two decimals it reads 1.00.
inline constexpr double inseparable = 0.995;

// Correlations of the estimates of coordinates at an optimum, from the covariance of the curvature there.
struct Correlations {
  // Off their bounds, with an influence on what is simulated: of others nothing can be said.
  std::vector<std::size_t> coordinates;
  Eigen::MatrixXd values;  // of these

  struct Pair {
    std::size_t first;  // place in `coordinates`
    std::size_t second;
    double r;
  };
  // Every two of different coordinates, the largest |r| first.
  [[nodiscard]] std::vector<Pair> pairs() const;
};

// `derivatives` of one point u, no more coordinates than it has.
Correlations correlations(const Response& derivatives, const std::vector<double>& u);

}  // namespace hysteron
