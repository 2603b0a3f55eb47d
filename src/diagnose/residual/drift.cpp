#include "diagnose/residual/drift.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/frequency.hpp"
#include "core/midranks.hpp"
#include "diagnose/residual/independent.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_recordings = 5;  // that tell a trend
// Chance explains a rank correlation whose t is below this (one in two thousand at six degrees of freedom), and a
// change of less than this many standard errors or this share of the parameter.
constexpr double least_t = 6.0;
constexpr double least_errors = 4.0;
constexpr double least_change = 0.03;

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = midranks(a);
  const std::vector<double> y = midranks(b);
  const double middle = 0.5 * (static_cast<double>(a.size()) + 1.0);
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    xx += (x[i] - middle) * (x[i] - middle);
    yy += (y[i] - middle) * (y[i] - middle);
    xy += (x[i] - middle) * (y[i] - middle);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

void find_what_it_follows(DriftOfParameter& row, const std::vector<DriftConditions>& conditions) {
  const std::size_t count = row.change.size();
  if (count < fewest_recordings) {
    return;
  }
  const auto [low, high] = std::ranges::minmax(row.change);
  std::vector<double> errors = row.std_error;
  std::ranges::sort(errors);
  if (high - low < std::max(least_change, least_errors * errors[count / 2])) {
    return;
  }
  for (std::size_t v = 0; v < drift_variables.size(); ++v) {
    std::vector<double> values(count);
    std::ranges::transform(conditions, values.begin(), [&](const DriftConditions& of) { return of[v]; });
    const double correlation = rank_correlation(row.change, values);
    const double t = std::fabs(correlation) *
                     std::sqrt((static_cast<double>(count) - 2.0) / std::max(1.0 - correlation * correlation, 1e-9));
    if (t > least_t && std::fabs(correlation) > std::fabs(row.rank_correlation)) {
      row.follows = drift_variables[v];
      row.rank_correlation = correlation;
    }
  }
}

}  // namespace

Drift drift_of(const std::vector<Recording>& recordings, const Residuals& residuals,
               const std::vector<Sensitivity>& sensitivities) {
  Drift result;
  for (const Recording& recording : recordings) {
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    const double drive = recording.drive.empty()
                             ? 0.0
                             : std::accumulate(recording.drive.begin(), recording.drive.end(), 0.0) /
                                   static_cast<double>(recording.size());
    result.recordings.push_back(recording.file);
    result.conditions.push_back(
        {0.5 * (high - low), dominant_frequency(recording), drive, static_cast<double>(result.conditions.size())});
  }
  for (const Sensitivity& sensitivity : sensitivities) {
    DriftOfParameter row;
    row.name = sensitivity.name;
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      const Residual& left = residuals.of[k];
      const std::vector<double>& slope = sensitivity.slope[k];
      double slopes = 0.0;
      double product = 0.0;
      double squares = 0.0;
      for (std::size_t n = left.from; n < slope.size(); ++n) {
        slopes += slope[n] * slope[n];
        product += slope[n] * left.force[n];
        squares += left.force[n] * left.force[n];
      }
      if (!(slopes > 0.0) || !std::isfinite(slopes) || !std::isfinite(squares)) {
        row.change.push_back(0.0);
        row.std_error.push_back(0.0);
        continue;
      }
      row.change.push_back(-product / slopes);
      // Of the samples that both make up, so many are independent.
      const double mean_slope = slopes / static_cast<double>(slope.size() - left.from);
      const double mean_square = squares / static_cast<double>(slope.size() - left.from);
      row.std_error.push_back(std::sqrt(mean_square / mean_slope / independent_values(recordings[k], left)));
    }
    find_what_it_follows(row, result.conditions);
    result.parameters.push_back(std::move(row));
  }
  return result;
}

}  // namespace hysteron
