#include "fit/jackknife.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>

#include "fit/curvature_directions.hpp"

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

// The groups of a recording from its rows, which come in order and few at a time.
class Stretches {
 public:
  Stretches(std::size_t samples, const std::vector<Eigen::Index>& free, std::size_t dimension)
      : samples_(samples), free_(free), dimension_(dimension) {
    groups_.resize(stretches, {Eigen::VectorXd::Zero(columns()), Eigen::MatrixXd::Zero(columns(), columns())});
  }

  void add(std::size_t count, const double* residual, const double* jacobian) {
    while (count > 0) {
      const std::size_t end = samples_ * (group_ + 1) / stretches;
      const std::size_t taken = std::min({count, end - at_, rows_at_once - residual_.size()});
      residual_.insert(residual_.end(), residual, residual + taken);
      jacobian_.insert(jacobian_.end(), jacobian, jacobian + taken * dimension_);
      residual += taken;
      jacobian += taken * dimension_;
      count -= taken;
      at_ += taken;
      if (at_ == end || residual_.size() == rows_at_once) sum_up();
      while (group_ + 1 < stretches && at_ == samples_ * (group_ + 1) / stretches) ++group_;
    }
  }
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

 private:
  static constexpr std::size_t rows_at_once = 1U << 16U;

  [[nodiscard]] Eigen::Index columns() const { return static_cast<Eigen::Index>(free_.size()); }

  void sum_up() {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto rows = static_cast<Eigen::Index>(residual_.size());
    const Eigen::Map<const RowMajor> all(jacobian_.data(), rows, static_cast<Eigen::Index>(dimension_));
    const Eigen::Map<const Eigen::VectorXd> residual(residual_.data(), rows);
    const Eigen::MatrixXd jacobian = all(Eigen::all, free_);
    groups_[group_].score += jacobian.transpose() * residual;
    groups_[group_].matrix += jacobian.transpose() * jacobian;
    residual_.clear();
    jacobian_.clear();
  }

  std::size_t samples_;
  const std::vector<Eigen::Index>& free_;
  std::size_t dimension_;
  std::vector<Group> groups_;
  std::size_t group_ = 0;
  std::size_t at_ = 0;
  std::vector<double> residual_;
  std::vector<double> jacobian_;
};

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

std::optional<Jackknife> jackknife_of(const std::vector<Stretches>& data, std::size_t count) {
  const auto m = static_cast<Eigen::Index>(count);
  std::vector<Group> parts;
  std::vector<Group> recordings;
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(m, m);
  for (const Stretches& one : data) {
    Group whole{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
    for (const Group& part : one.groups()) {
      whole.score += part.score;
      whole.matrix += part.matrix;
      parts.push_back(part);
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

}  // namespace

std::optional<Jackknife> jackknife(const std::vector<Linearised>& data, const std::vector<Eigen::Index>& free,
                                   std::size_t dimension) {
  std::vector<Stretches> sums;
  for (const Linearised& one : data) {
    sums.emplace_back(one.residual.size(), free, dimension)
        .add(one.residual.size(), one.residual.data(), one.jacobian.data());
  }
  return jackknife_of(sums, free.size());
}

std::optional<Jackknife> jackknife(const Objective& objective, const std::vector<double>& point,
                                   const std::vector<Eigen::Index>& free) {
  std::vector<Stretches> sums;
  for (const Target& target : objective.targets()) {
    sums.emplace_back(target.force.size(), free, objective.layout().dimension());
  }
  objective.linearise(point,
                      [&](std::size_t recording, std::size_t /*begin*/, std::size_t count, const double* residual,
                          const double* jacobian) { sums[recording].add(count, residual, jacobian); });
  return jackknife_of(sums, free.size());
}

}  // namespace hysteron
