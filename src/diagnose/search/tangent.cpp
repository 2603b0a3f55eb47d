#include "diagnose/search/tangent.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

namespace hysteron {
namespace {

// Of the largest direction, for exact derivatives: below it there is none.
constexpr double rank_tolerance = 1e-7;

}  // namespace

Eigen::MatrixXd orthonormal_basis(Eigen::MatrixXd slopes, double threshold) {
  for (Eigen::Index c = 0; c < slopes.cols(); ++c) {
    const double norm = slopes.col(c).norm();
    slopes.col(c) =
        std::isfinite(norm) && norm > 0.0 ? (slopes.col(c) / norm).eval() : Eigen::VectorXd::Zero(slopes.rows()).eval();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(slopes);
  qr.setThreshold(threshold);
  return qr.householderQ() * Eigen::MatrixXd::Identity(slopes.rows(), qr.rank());
}

Tangent tangent_of(const Workbench& bench, const Fit& fit) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  const std::vector<Linearised> all = objective.linearised(fit.point);
  const auto d = static_cast<Eigen::Index>(fit.dimension());
  Tangent result;
  result.residual.resize(static_cast<Eigen::Index>(objective.samples()));
  Eigen::MatrixXd slopes(result.residual.size(), d);
  Eigen::Index row = 0;
  for (const Linearised& part : all) {
    const auto size = static_cast<Eigen::Index>(part.residual.size());
    result.residual.segment(row, size) = Eigen::Map<const Eigen::VectorXd>(part.residual.data(), size);
    slopes.middleRows(row, size) =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(part.jacobian.data(),
                                                                                                 size, d);
    row += size;
  }
  result.basis = orthonormal_basis(std::move(slopes), rank_tolerance);
  result.left = result.residual - result.basis * (result.basis.transpose() * result.residual);
  return result;
}

}  // namespace hysteron
