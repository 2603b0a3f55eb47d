#include "fit/jackknife.hpp"

#include <boost/math/distributions/students_t.hpp>

#include "fit/correlation.hpp"

namespace hysteron {
namespace {

constexpr std::size_t stretches = 8;
constexpr std::size_t least_recordings = 3;
// A group that alone tells a direction fits it exactly and moves it without bound when left out: neither says how well
// it is known.
constexpr double most_leverage = 0.8;

struct Group {
  Eigen::VectorXd score;   // J^T r
  Eigen::MatrixXd matrix;  // J^T J
};

Group group_of(const Linearised& data, std::size_t begin, std::size_t end, const std::vector<Eigen::Index>& free,
               std::size_t dimension) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(end - begin);
  const auto d = static_cast<Eigen::Index>(dimension);
  const Eigen::Map<const RowMajor> all(data.jacobian.data() + begin * dimension, rows, d);
  const Eigen::Map<const Eigen::VectorXd> residual(data.residual.data() + begin, rows);
  const Eigen::MatrixXd jacobian = all(Eigen::all, free);
  return {jacobian.transpose() * residual, jacobian.transpose() * jacobian};
}

// x' with (sum of matrices) = identity in the new coordinates, directions that the data leave open left out:
// x = transform x'.
Eigen::MatrixXd whitening(const Eigen::MatrixXd& matrix) {
  const CorrelationEigen eigen(matrix);
  std::vector<Eigen::Index> told;
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    if (!eigen.open(k)) {
      told.push_back(k);
    }
  }
  const Eigen::VectorXd root = eigen.values(told).cwiseSqrt();
  return eigen.norm.cwiseInverse().asDiagonal() * eigen.vectors(Eigen::all, told) * root.cwiseInverse().asDiagonal();
}

Spread spread_of(const std::vector<Group>& groups, const Eigen::MatrixXd& transform) {
  const auto count = static_cast<double>(groups.size());
  Eigen::MatrixXd moves(transform.cols(), static_cast<Eigen::Index>(groups.size()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> leverage(transform.transpose() * groups[g].matrix * transform);
    const Eigen::VectorXd left = 1.0 - leverage.eigenvalues().array().min(most_leverage);
    const Eigen::MatrixXd& directions = leverage.eigenvectors();
    moves.col(static_cast<Eigen::Index>(g)) = directions * left.cwiseInverse().asDiagonal() * directions.transpose() *
                                              (transform.transpose() * groups[g].score);
  }
  const Eigen::MatrixXd centred = moves.colwise() - moves.rowwise().mean();
  const Eigen::MatrixXd covariance = (count - 1.0) / count * centred * centred.transpose();
  return {transform * covariance * transform.transpose(),
          boost::math::quantile(boost::math::students_t(count - 1.0), 0.975)};
}

}  // namespace

std::optional<Jackknife> jackknife(const std::vector<Linearised>& data, const std::vector<Eigen::Index>& free,
                                   std::size_t dimension) {
  const auto m = static_cast<Eigen::Index>(free.size());
  std::vector<Group> parts;
  std::vector<Group> recordings;
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(m, m);
  for (const Linearised& one : data) {
    const std::size_t size = one.residual.size();
    Group whole{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
    for (std::size_t k = 0; k < stretches; ++k) {
      Group part = group_of(one, size * k / stretches, size * (k + 1) / stretches, free, dimension);
      whole.score += part.score;
      whole.matrix += part.matrix;
      parts.push_back(std::move(part));
    }
    total += whole.matrix;
    recordings.push_back(std::move(whole));
  }
  if (!total.allFinite()) {
    return std::nullopt;
  }
  const Eigen::MatrixXd transform = whitening(total);
  if (transform.cols() == 0) {
    return std::nullopt;
  }
  Jackknife result{spread_of(parts, transform), std::nullopt};
  if (recordings.size() >= least_recordings) {
    result.recordings = spread_of(recordings, transform);
  }
  return result;
}

}  // namespace hysteron
