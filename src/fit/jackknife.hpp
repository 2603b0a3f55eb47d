// How far the optimum moves when part of the data is left out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/objective.hpp"

namespace hysteron {

// Spread of the optimum over groups of samples.
struct Spread {
  Eigen::MatrixXd covariance;  // of the free unit coordinates
  double quantile;             // of Student's t, two-sided 95 %, groups - 1 degrees of freedom
};

struct Jackknife {
  Spread stretches;                  // groups: eighths of every recording
  std::optional<Spread> recordings;  // groups: recordings, where there are three or more
};

// Delete-one-group jackknife to first order. It asks nothing of the residual's colour or of its evenness: what the
// model misses in one stretch or recording and not in another widens the intervals, where a formula for white noise
// would have them narrow. `free`: the coordinates that are not on a bound, one at least. Source: Cameron and Miller, A
// practitioner's guide to cluster-robust inference, J. Human Resources 50 (2015) 317 (CR3), with the leverage of a
// group cut where it is nearly alone in telling a direction.
// Empty where the derivatives are not finite or tell no direction.
std::optional<Jackknife> jackknife(const std::vector<Linearised>& data, const std::vector<Eigen::Index>& free,
                                   std::size_t dimension);
// The same of an objective at a point, without all derivatives in memory.
std::optional<Jackknife> jackknife(const Objective& objective, const std::vector<double>& point,
                                   const std::vector<Eigen::Index>& free);

}  // namespace hysteron
