// Which directions of the coordinates the data tell: the Gauss-Newton matrix scaled to unit diagonal, by eigenvalues.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
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

  // Of the scaled matrix, of the directions that the data tell.
  [[nodiscard]] Eigen::MatrixXd told_inverse() const { return inverse_of(false); }
  // Of all: open directions count as far as they can be told from nothing, so that the coordinates in them correlate
  // fully.
  [[nodiscard]] Eigen::MatrixXd inverse() const { return inverse_of(true); }

 private:
  [[nodiscard]] Eigen::MatrixXd inverse_of(bool all) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.size(), values.size());
    for (Eigen::Index e = 0; e < values.size(); ++e) {
      if (all || !open(e)) {
        result += vectors.col(e) * vectors.col(e).transpose() / std::max(values[e], open_direction);
      }
    }
    return result;
  }
};

// Covariances over the standard deviations, whatever the scale of each coordinate.
inline Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      if (i != j) result(i, j) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
    }
  }
  return result;
}

}  // namespace hysteron
