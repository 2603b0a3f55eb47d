#include "core/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/extent.hpp"
#include "core/robust.hpp"

namespace hysteron {
namespace {

constexpr double least_variation = 0.02;  // of the largest size
constexpr double least_over_noise = 12.0;
constexpr double agreement = 9.8;  // four standard deviations of a second difference
constexpr std::size_t reach = 8;
constexpr std::size_t least_samples = 16;

// At sample n, of the parabola of least squares through it and `beside` samples to both sides.
//   y = sum_k w_k drive_(n+k),   w_k = 3 (3 m^2 + 3 m - 1 - 5 k^2) / ((2 m - 1) (2 m + 1) (2 m + 3))
// Savitzky and Golay 1964, doi 10.1021/ac60214a047: a mean would flatten what is curved.
double middle_of_parabola(const std::vector<double>& drive, std::size_t n, std::size_t beside) {
  if (beside == 0) {
    return drive[n];
  }
  const auto m = static_cast<double>(beside);
  const double top = 3.0 * m * m + 3.0 * m - 1.0;
  double sum = top * drive[n];
  for (std::size_t k = 1; k <= beside; ++k) {
    const auto away = static_cast<double>(k);
    sum += (top - 5.0 * away * away) * (drive[n - k] + drive[n + k]);
  }
  return 3.0 * sum / ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
}

// What the drive has to move by not to be constant.
double least_move(const std::vector<double>& drive) {
  const auto [low, high] = std::ranges::minmax(drive);
  return std::max(least_variation * std::max(std::fabs(low), std::fabs(high)), least_over_noise * drive_noise(drive));
}

}  // namespace

std::vector<double> fourth_differences(const std::vector<double>& values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (std::size_t n = 4; n < values.size(); ++n) {
    result.push_back((values[n - 4] - 4.0 * values[n - 3] + 6.0 * values[n - 2] - 4.0 * values[n - 1] + values[n]) /
                     std::sqrt(70.0));
  }
  return result;
}

double drive_noise(const std::vector<double>& drive) {
  if (drive.size() < least_samples) {
    return 0.0;
  }
  return robust_deviation(fourth_differences(drive));
}

bool varies(const std::vector<double>& drive) {
  if (drive.empty()) {
    return false;
  }
  const auto [low, high] = std::ranges::minmax(drive);
  return high - low > least_move(drive);
}

bool returns(const std::vector<double>& drive) { return !drive.empty() && turned_by(drive) > least_move(drive); }

std::size_t count_levels(std::vector<double> values) {
  if (values.empty()) {
    return 0;
  }
  std::ranges::sort(values);
  const double width = least_variation * std::max(std::fabs(values.front()), std::fabs(values.back()));
  std::size_t count = 1;
  double level = values.front();
  for (const double value : values) {
    if (value - level > width) {
      ++count;
      level = value;
    }
  }
  return count;
}

std::vector<double> quiet_drive(const std::vector<double>& drive) {
  if (drive.empty()) {
    return {};
  }
  if (!varies(drive)) {
    const double mean = std::accumulate(drive.begin(), drive.end(), 0.0) / static_cast<double>(drive.size());
    return std::vector<double>(drive.size(), mean);
  }
  const double limit = agreement * drive_noise(drive);
  std::vector<double> result(drive.size());
  for (std::size_t n = 0; n < drive.size(); ++n) {
    std::size_t alike = 0;
    while (alike < std::min({reach, n, drive.size() - 1 - n}) &&
           std::fabs(drive[n - alike - 1] + drive[n + alike + 1] - 2.0 * drive[n]) <= limit) {
      ++alike;
    }
    result[n] = middle_of_parabola(drive, n, alike);
  }
  return result;
}

std::vector<double> quiet_condition(const std::vector<double>& values) {
  if (values.empty() || varies(values)) {
    return quiet_drive(values);
  }
  const auto [low, high] = std::ranges::minmax(values);
  // The mean of equal numbers is not always theirs.
  return {low == high ? low : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size())};
}

}  // namespace hysteron
