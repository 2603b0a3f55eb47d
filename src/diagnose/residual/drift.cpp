#include "diagnose/residual/drift.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/midranks.hpp"

namespace hysteron {
namespace {

constexpr double step = 1e-3;  // relative, of the parameter
constexpr std::size_t fewest_recordings = 5;
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

Drift drift_of(const Workbench& bench, const Fit& fit) {
  Drift result;
  const std::vector<Recording>& recordings = bench.split().fit;
  std::vector<Residual> left;
  for (const Recording& recording : recordings) {
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    const double drive = recording.drive.empty()
                             ? 0.0
                             : std::accumulate(recording.drive.begin(), recording.drive.end(), 0.0) /
                                   static_cast<double>(recording.size());
    result.recordings.push_back(recording.file);
    result.conditions.push_back(
        {0.5 * (high - low), dominant_frequency(recording), drive, static_cast<double>(result.conditions.size())});
    left.push_back(bench.residual(fit, recording));
  }
  for (const ParameterLaw& law : fit.layout->laws()) {
    DriftOfParameter row;
    row.name = fit.layout->names()[law.parameter];
    // Of what may be zero no relative change can be told.
    if (row.name.find('.') != std::string::npos || fit.layout->cards()[law.parameter].lower < 0.0) {
      continue;
    }
    Fit moved = fit;
    for (Term& term : moved.terms) {
      if (term.parameter == law.parameter) {
        term.value *= 1.0 + step;
      }
    }
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      const Residual there = bench.residual(moved, recordings[k]);
      double slopes = 0.0;
      double product = 0.0;
      double squares = 0.0;
      double neighbours = 0.0;
      double count = 0.0;
      double before = 0.0;
      for (std::size_t n = left[k].from; n < there.force.size(); ++n) {
        const double residual = left[k].force[n];
        const double slope = (there.force[n] - residual) / step;
        slopes += slope * slope;
        product += slope * residual;
        squares += residual * residual;
        neighbours += residual * before;
        before = residual;
        count += 1.0;
      }
      if (!(slopes > 0.0) || !std::isfinite(slopes) || !std::isfinite(squares)) {
        row.change.push_back(0.0);
        row.std_error.push_back(0.0);
        continue;
      }
      const double correlation = std::clamp(squares > 0.0 ? neighbours / squares : 0.0, 0.0, 0.999);
      row.change.push_back(-product / slopes);
      row.std_error.push_back(std::sqrt(squares / count * (1.0 + correlation) / (1.0 - correlation) / slopes));
    }
    find_what_it_follows(row, result.conditions);
    result.parameters.push_back(std::move(row));
  }
  return result;
}

}  // namespace hysteron
