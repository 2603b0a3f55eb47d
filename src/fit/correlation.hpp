// Which directions of the coordinates the data tell: the Gauss-Newton matrix scaled to unit diagonal, by eigenvalues.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace hysteron {

// Below this eigenvalue the data say nothing of a direction.
inline constexpr double open_direction = 1e-9;

// `matrix` symmetric; its scaled form is V diag(values) V^T with V = vectors, and matrix = norm * scaled * norm.
struct CorrelationEigen {
  Eigen::VectorXd norm;
  Eigen::VectorXd values;  // ascending
  Eigen::MatrixXd vectors;

  explicit CorrelationEigen(const Eigen::MatrixXd& matrix) : norm(matrix.diagonal().cwiseMax(1e-300).cwiseSqrt()) {
    const Eigen::MatrixXd scaled = norm.cwiseInverse().asDiagonal() * matrix * norm.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
  }
  [[nodiscard]] bool open(Eigen::Index direction) const { return values[direction] <= open_direction; }
};

}  // namespace hysteron
