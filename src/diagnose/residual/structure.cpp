#include "diagnose/residual/structure.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/signal/features.hpp"

namespace hysteron {
namespace {

constexpr int grid = 9;            // nodes of displacement and of velocity
constexpr int reversal_bins = 12;  // nodes of the distance since a reversal, for each direction
constexpr int drive_bins = 8;      // nodes of the drive
constexpr int grid_begin = 1;      // after the constant
constexpr int reversal_begin = grid_begin + grid * grid;
constexpr int drive_begin = reversal_begin + 2 * reversal_bins;
constexpr int feature_count = drive_begin + 4 * drive_bins;
constexpr std::size_t active_features = 4;  // that are not zero at a sample: the corners of a cell
constexpr int stretches = 6;                // of a recording, each predicted from the others
constexpr double ridge = 4.0;               // samples that a feature needs before it counts half

int bin_of(double position, int count) { return std::clamp(static_cast<int>(position * count), 0, count - 1); }

using Active = std::array<int, active_features>;

std::vector<Active> active(const Recording& recording) {
  const Features features = features_of(recording);
  std::vector<Active> rows(recording.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const double x = (recording.displacement[n] - features.centre) / std::max(features.stroke, 1e-12);
    const double v = recording.velocity[n] / std::max(features.speed, 1e-12);
    // Finer towards zero velocity, where hysteresis lives.
    const double warped = std::copysign(std::sqrt(std::fabs(v)), v);
    const int direction = v < 0.0 ? 0 : 1;
    const double since = features.since_reversal_distance[n] / std::max(2.0 * features.stroke, 1e-12);
    rows[n] = {0, grid_begin + bin_of(0.5 * (x + 1.0), grid) * grid + bin_of(0.5 * (warped + 1.0), grid),
               reversal_begin + direction * reversal_bins + bin_of(std::sqrt(since), reversal_bins), 0};
    if (!features.drive_step.empty() && features.drive_step[n] != 0.0) {
      const double late = std::log2(1.0 + features.since_drive_change[n] / 2e-3) / 8.0;
      rows[n][3] = drive_begin + ((features.drive_step[n] < 0.0 ? 0 : 1) + 2 * direction) * drive_bins +
                   bin_of(late, drive_bins);
    }
  }
  return rows;
}

}  // namespace

double predictable_share(const Recording& recording, const std::vector<double>& residual) {
  const std::size_t size = recording.size();
  if (size < 200) {
    return 0.0;
  }
  const std::vector<Active> rows = active(recording);
  // Outliers are cut at five root mean squares of the residual.
  double square = 0.0;
  for (const double r : residual) {
    square += r * r;
  }
  const double limit = 5.0 * std::sqrt(square / static_cast<double>(size));
  std::vector<Eigen::MatrixXd> matrix(stretches, Eigen::MatrixXd::Zero(feature_count, feature_count));
  std::vector<Eigen::VectorXd> right(stretches, Eigen::VectorXd::Zero(feature_count));
  const auto stretch_of = [&](std::size_t n) { return n * stretches / size; };
  std::vector<double> target(size);
  for (std::size_t n = 0; n < size; ++n) {
    target[n] = std::clamp(residual[n], -limit, limit);
    for (std::size_t i = 0; i < active_features; ++i) {
      if (i == 3 && rows[n][i] == 0) {
        continue;
      }
      right[stretch_of(n)][rows[n][i]] += target[n];
      for (std::size_t j = 0; j < active_features; ++j) {
        if (j != 3 || rows[n][j] != 0) {
          matrix[stretch_of(n)](rows[n][i], rows[n][j]) += 1.0;
        }
      }
    }
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(feature_count, feature_count);
  Eigen::VectorXd all_right = Eigen::VectorXd::Zero(feature_count);
  for (std::size_t s = 0; s < stretches; ++s) {
    all += matrix[s];
    all_right += right[s];
  }
  double before = 0.0;
  double after = 0.0;
  for (std::size_t s = 0; s < stretches; ++s) {
    Eigen::MatrixXd learned = all - matrix[s];
    learned.diagonal().array() += ridge;
    const Eigen::VectorXd weights = learned.ldlt().solve(all_right - right[s]);
    for (std::size_t n = 0; n < size; ++n) {
      if (stretch_of(n) != s) {
        continue;
      }
      double predicted = weights[rows[n][0]] + weights[rows[n][1]] + weights[rows[n][2]];
      if (rows[n][3] != 0) {
        predicted += weights[rows[n][3]];
      }
      before += target[n] * target[n];
      after += (target[n] - predicted) * (target[n] - predicted);
    }
  }
  return before > 0.0 ? 1.0 - after / before : 0.0;
}

}  // namespace hysteron
