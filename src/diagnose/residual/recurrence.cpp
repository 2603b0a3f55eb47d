#include "diagnose/residual/recurrence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/residual/surrogate.hpp"
#include "diagnose/signal/features.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 200;  // of a recording that is looked at
constexpr Eigen::Index chances = 19;
// Outliers are cut at this many root mean squares of the residual.
constexpr double cut = 5.0;
// Functions that are nearly the same are told apart by no more than this part of their squares.
constexpr double ridge = 1e-4;
// Stretch of a reversal, of half the stroke.
constexpr double reversal = 0.2;
constexpr std::size_t states = 21;

// The sizes of the motion over all recordings.
struct Scales {
  double stroke = 1e-300;
  double speed = 1e-300;
  double acceleration = 1e-300;
  double force = 1e-300;
  double least_drive = 1e300;
  double most_drive = -1e300;

  [[nodiscard]] double drive(double value) const {
    return most_drive > least_drive ? (value - least_drive) / (most_drive - least_drive) : 0.0;
  }
};

void widen(double& largest, const std::vector<double>& values) {
  for (const double value : values) {
    largest = std::max(largest, std::fabs(value));
  }
}

Scales scales_of(const std::vector<Recording>& recordings) {
  Scales result;
  for (const Recording& recording : recordings) {
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    result.stroke = std::max(result.stroke, 0.5 * (high - low));
    widen(result.speed, recording.velocity);
    widen(result.force, recording.force);
    widen(result.acceleration, recording.derived_acceleration);
    for (const double drive : recording.drive) {
      result.least_drive = std::min(result.least_drive, drive);
      result.most_drive = std::max(result.most_drive, drive);
    }
  }
  return result;
}

// Simulated force in units of the largest measured one, from the first sample that counts on.
Eigen::VectorXd simulated(const Recording& recording, const Residual& residual, const Scales& scales) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(recording.size() - residual.from));
  for (std::size_t n = residual.from; n < recording.size(); ++n) {
    result[static_cast<Eigen::Index>(n - residual.from)] = (recording.force[n] + residual.force[n]) / scales.force;
  }
  return result;
}

// The functions at every sample, a column each: those of the state, and these times the stroke and times the drive.
Eigen::MatrixXd functions(const Recording& recording, std::size_t from, const Eigen::VectorXd& force,
                          const Scales& scales) {
  const Features features = features_of(recording);
  const double stroke = features.stroke / scales.stroke;
  Eigen::MatrixXd result(force.size(), static_cast<Eigen::Index>(3 * states));
  for (Eigen::Index row = 0; row < force.size(); ++row) {
    const std::size_t n = from + static_cast<std::size_t>(row);
    const double x = (recording.displacement[n] - features.centre) / scales.stroke;
    const double v = recording.velocity[n] / scales.speed;
    const double speed = std::fabs(v);
    // Finer towards zero velocity, where hysteresis lives.
    const double warped = std::copysign(std::sqrt(speed), v);
    const double f = force[row];
    const double a = recording.derived_acceleration.empty() ? 0.0 : recording.derived_acceleration[n];
    const double since = features.since_reversal_distance[n] / std::max(features.stroke, 1e-300);
    const double turned = std::copysign(std::exp(-since / reversal), v);
    const std::array<double, states> state = {
        1.0,       x,         x * x,     x * x * x, warped,       warped * speed, v,
        v * v * v, speed,     f,         f * f * f, std::fabs(f), x * warped,     x * x * warped,
        x * f,     x * x * f, speed * f, x * v,     turned,       turned * f,     a / scales.acceleration};
    const double drive = recording.drive.empty() ? 0.0 : scales.drive(recording.drive[n]);
    Eigen::Index column = 0;
    for (const double factor : {1.0, stroke, drive}) {
      for (const double value : state) {
        result(row, column++) = factor * value;
      }
    }
  }
  return result;
}

// Takes a constant and the best multiple of the force off every column.
void take_off(Eigen::MatrixXd& columns, const Eigen::VectorXd& force) {
  const Eigen::VectorXd swing = force.array() - force.mean();
  const double square = std::max(swing.squaredNorm(), 1e-300);
  columns.rowwise() -= columns.colwise().mean().eval();
  const Eigen::RowVectorXd factors = swing.transpose() * columns / square;
  columns -= swing * factors;
}

// The residual without what recordings may differ by, and its surrogates, a column each.
Eigen::MatrixXd surrogates(const Recording& recording, const Residual& residual, double norm,
                           const Eigen::VectorXd& force, const Stream& stream) {
  const Eigen::Map<const Eigen::VectorXd> all(residual.force.data(), static_cast<Eigen::Index>(residual.force.size()));
  Eigen::MatrixXd own = all.tail(all.size() - static_cast<Eigen::Index>(residual.from)) / norm;
  const double limit = cut * std::sqrt(own.squaredNorm() / static_cast<double>(own.size()));
  own = own.cwiseMax(-limit).cwiseMin(limit);
  take_off(own, force);
  const std::vector<double> values(own.data(), own.data() + own.size());
  const std::vector<std::size_t> blocks = half_cycles(recording, residual.from);
  Eigen::MatrixXd result(own.rows(), 1 + chances);
  result.col(0) = own;
  for (Eigen::Index s = 1; s <= chances; ++s) {
    const std::vector<double> one = surrogate(values, blocks, stream.child(static_cast<std::uint64_t>(s)));
    result.col(s) = Eigen::Map<const Eigen::VectorXd>(one.data(), own.rows());
  }
  take_off(result, force);
  return result;
}

}  // namespace

Recurrence recurrence_of(const std::vector<Recording>& recordings, const Residuals& residuals) {
  const std::vector<double>& norms = residuals.norms;
  const Scales scales = scales_of(recordings);
  const Stream stream = Stream(0).child("recurrence");
  constexpr auto count = static_cast<Eigen::Index>(3 * states);
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd with = Eigen::MatrixXd::Zero(count, 1 + chances);
  Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(1 + chances);
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    if (recordings[k].size() < residuals.of[k].from + fewest_samples) {
      continue;
    }
    const Eigen::VectorXd force = simulated(recordings[k], residuals.of[k], scales);
    Eigen::MatrixXd motion = functions(recordings[k], residuals.of[k].from, force, scales) / norms[k];
    const Eigen::MatrixXd left = surrogates(recordings[k], residuals.of[k], norms[k], force, stream.child(k));
    take_off(motion, force);
    half.selfadjointView<Eigen::Lower>().rankUpdate(motion.transpose());
    // Column by column: Eigen would part a product of matrices of this size among threads of its own.
    for (Eigen::Index s = 0; s <= chances; ++s) {
      with.col(s) += motion.transpose() * left.col(s);
    }
    squares += left.colwise().squaredNorm();
  }
  if (!(squares[0] > 0.0)) {
    return {};
  }
  const Eigen::MatrixXd among = half.selfadjointView<Eigen::Lower>();
  Eigen::MatrixXd damped = among;
  const double least = 1e-12 * among.diagonal().maxCoeff();
  damped.diagonal() += (ridge * among.diagonal()).cwiseMax(least);
  const Eigen::MatrixXd weights = damped.ldlt().solve(with);
  const Eigen::RowVectorXd taken =
      (2.0 * weights.cwiseProduct(with) - weights.cwiseProduct(among * weights)).colwise().sum();
  const Eigen::RowVectorXd shares = taken.cwiseQuotient(squares.cwiseMax(1e-300));
  return {shares[0], shares.tail(chances).mean(), shares.tail(chances).maxCoeff()};
}

}  // namespace hysteron
