#include "fit/jackknife.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr std::size_t dimension = 3;
constexpr std::size_t samples = 160;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Linear least squares: recordings of y = J theta + noise, with a part of the noise common to each recording.
struct LinearData {
  std::vector<RowMajor> jacobian;
  std::vector<Eigen::VectorXd> y;

  LinearData(std::uint64_t seed, std::size_t recordings, double common) {
    const Stream stream(seed);
    std::uint64_t draw = 0;
    for (std::size_t r = 0; r < recordings; ++r) {
      RowMajor rows(samples, dimension);
      Eigen::VectorXd values(samples);
      Eigen::Vector3d off;
      for (Eigen::Index c = 0; c < off.size(); ++c) off[c] = common * stream.normal(draw++);
      for (Eigen::Index n = 0; n < rows.rows(); ++n) {
        for (Eigen::Index c = 0; c < rows.cols(); ++c) rows(n, c) = stream.normal(draw++);
        values[n] = rows.row(n) * (Eigen::Vector3d(1.0, -2.0, 0.5) + off) + stream.normal(draw++);
      }
      jacobian.push_back(rows);
      y.push_back(values);
    }
  }

  // Without samples [begin, end) of a recording (recording == count: all of it stays).
  [[nodiscard]] Eigen::VectorXd solved(std::size_t recording, Eigen::Index begin, Eigen::Index end) const {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(dimension, dimension);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(dimension);
    for (std::size_t r = 0; r < y.size(); ++r) {
      for (Eigen::Index n = 0; n < y[r].size(); ++n) {
        if (r == recording && n >= begin && n < end) continue;
        matrix += jacobian[r].row(n).transpose() * jacobian[r].row(n);
        right += jacobian[r].row(n).transpose() * y[r][n];
      }
    }
    return matrix.ldlt().solve(right);
  }

  [[nodiscard]] std::vector<Linearised> linearised() const {
    const Eigen::VectorXd best = solved(y.size(), 0, 0);
    std::vector<Linearised> result;
    for (std::size_t r = 0; r < y.size(); ++r) {
      const Eigen::VectorXd residual = jacobian[r] * best - y[r];
      result.push_back(
          {{residual.begin(), residual.end()}, {jacobian[r].data(), jacobian[r].data() + jacobian[r].size()}});
    }
    return result;
  }
};

Eigen::MatrixXd covariance_of(const std::vector<Eigen::VectorXd>& optima) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(dimension);
  for (const Eigen::VectorXd& one : optima) mean += one / static_cast<double>(optima.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dimension, dimension);
  for (const Eigen::VectorXd& one : optima) sum += (one - mean) * (one - mean).transpose();
  const auto count = static_cast<double>(optima.size());
  return (count - 1.0) / count * sum;
}

const std::vector<Eigen::Index> every = {0, 1, 2};

Jackknife told(const std::vector<Linearised>& data, const std::vector<Eigen::Index>& free, std::size_t count) {
  return jackknife(data, free, count).value();
}

TEST(Jackknife, IsTheExactOneForLinearLeastSquares) {
  const LinearData data(11, 5, 0.3);
  const Jackknife found = told(data.linearised(), every, dimension);
  std::vector<Eigen::VectorXd> by_recording;
  std::vector<Eigen::VectorXd> by_stretch;
  for (std::size_t r = 0; r < 5; ++r) {
    by_recording.push_back(data.solved(r, 0, samples));
    for (Eigen::Index k = 0; k < 8; ++k) {
      by_stretch.push_back(
          data.solved(r, k * static_cast<Eigen::Index>(samples) / 8, (k + 1) * static_cast<Eigen::Index>(samples) / 8));
    }
  }
  ASSERT_TRUE(found.recordings.has_value());
  EXPECT_LT((found.recordings->covariance - covariance_of(by_recording)).norm(), 1e-10);
  EXPECT_LT((found.stretches.covariance - covariance_of(by_stretch)).norm(), 1e-10);
  EXPECT_NEAR(found.recordings->quantile, 2.776, 1e-3);  // Student's t, 4 degrees of freedom
  EXPECT_NEAR(found.stretches.quantile, 2.023, 1e-3);    // 39
}

// What differs between recordings makes the formula for independent samples far too narrow, and the jackknife not.
TEST(Jackknife, HoldsTheTruthAsOftenAsItSays) {
  const Eigen::Vector3d truth(1.0, -2.0, 0.5);
  int inside = 0;
  int inside_classical = 0;
  constexpr int campaigns = 200;
  for (int k = 0; k < campaigns; ++k) {
    const LinearData data(100 + static_cast<std::uint64_t>(k), 6, 0.3);
    const Eigen::VectorXd best = data.solved(6, 0, 0);
    const Jackknife found = told(data.linearised(), every, dimension);
    const double error = std::fabs(best[0] - truth[0]);
    const Spread& recordings = found.recordings.value();
    inside += error < recordings.quantile * std::sqrt(recordings.covariance(0, 0)) ? 1 : 0;
    inside_classical += error < 1.96 / std::sqrt(6.0 * samples) ? 1 : 0;
  }
  // Binomial, 200 at 95 %: four standard deviations are 12.
  EXPECT_GT(inside, 178);
  EXPECT_LT(inside_classical, 120);
}

TEST(Jackknife, OneRecordingHasStretchesOnly) {
  const Jackknife found = told(LinearData(3, 1, 0.0).linearised(), {0, 2}, dimension);
  EXPECT_FALSE(found.recordings.has_value());
  EXPECT_EQ(found.stretches.covariance.rows(), 2);
}

TEST(Jackknife, TellsNothingFromDerivativesThatAreNotFiniteOrAllZero) {
  std::vector<Linearised> data = LinearData(3, 3, 0.0).linearised();
  data[1].jacobian[7] = std::nan("");
  EXPECT_FALSE(jackknife(data, every, dimension).has_value());
  for (Linearised& one : data) std::ranges::fill(one.jacobian, 0.0);
  EXPECT_FALSE(jackknife(data, every, dimension).has_value());
}

}  // namespace
}  // namespace hysteron
