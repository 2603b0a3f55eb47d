// What a fit leaves beside what its own parameters can do to first order.
#pragma once

#include <Eigen/Core>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Samples of the fitted recordings one after the other, weighted so that the squares sum to those of NRMSE; zero in the
// run-in.
struct Tangent {
  Eigen::VectorXd residual;  // as simulated
  Eigen::VectorXd left;      // beside the basis
  Eigen::MatrixXd basis;     // orthonormal, of the fit's derivatives
};
Tangent tangent_of(const Workbench& bench, const Fit& fit);

// Orthonormal columns that span those of `slopes`, each scaled to one; what is not finite or zero spans nothing, nor
// does what the others span but for `threshold` of the largest direction.
Eigen::MatrixXd orthonormal_basis(Eigen::MatrixXd slopes, double threshold);

}  // namespace hysteron
