#include "fit/correlations.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fit/curvature_directions.hpp"
#include "fit/free_coordinates.hpp"

namespace hysteron {

std::vector<Correlations::Pair> Correlations::pairs() const {
  std::vector<Pair> result;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    for (std::size_t j = i + 1; j < coordinates.size(); ++j) {
      result.push_back({i, j, values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))});
    }
  }
  std::ranges::stable_sort(result, [](const Pair& a, const Pair& b) { return std::fabs(a.r) > std::fabs(b.r); });
  return result;
}

Correlations correlations(const Response& derivatives, const std::vector<double>& u) {
  const auto d = static_cast<Eigen::Index>(u.size());
  const Eigen::Map<const Eigen::MatrixXd> full(derivatives.gauss_newton.data(), d, d);
  Correlations result;
  std::vector<Eigen::Index> told;
  for (const Eigen::Index k : free_coordinates(u)) {
    if (std::isfinite(full(k, k)) && full(k, k) > 0.0) {
      told.push_back(k);
      result.coordinates.push_back(static_cast<std::size_t>(k));
    }
  }
  if (!told.empty()) result.values = correlation_of(CorrelationEigen(full(told, told)).inverse());
  return result;
}

}  // namespace hysteron
