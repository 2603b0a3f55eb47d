#include "diagnose/search/signature.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/search/tangent.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr double nudge = 1e-3;           // of the box, for a derivative
constexpr double rank_tolerance = 1e-9;  // of the largest direction, for derivatives by differences

}  // namespace

Eigen::VectorXd stacked(const Workbench& bench, const Fit& fit) {
  std::vector<double> all;
  for (const Recording& recording : bench.split().fit) {
    const Residual residual = bench.residual(fit, recording);
    const double norm = normaliser(recording, bench.options().normalisation);
    for (std::size_t n = residual.from; n < residual.force.size(); ++n) {
      all.push_back(residual.force[n] / norm);
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Fit moved(Fit fit, const std::vector<std::size_t>& coordinates, double by) {
  for (const std::size_t c : coordinates) {
    fit.point[c] = std::clamp(fit.point[c] + by, 0.0, 1.0);
  }
  fit.terms = fit.layout->terms(fit.point);
  return fit;
}

Eigen::MatrixXd imitable(const Workbench& bench, const Fit& fit, const Eigen::VectorXd& at) {
  Eigen::MatrixXd slopes(at.size(), static_cast<Eigen::Index>(fit.dimension()));
  parallel_for(fit.dimension(), bench.options().threads, [&](std::size_t c) {
    const double by = fit.point[c] > 0.5 ? -nudge : nudge;
    slopes.col(static_cast<Eigen::Index>(c)) = (stacked(bench, moved(fit, {c}, by)) - at) / by;
  });
  return orthonormal_basis(std::move(slopes), rank_tolerance);
}

std::vector<std::size_t> size_of(const Fit& fit, const std::string& effect) {
  std::vector<std::size_t> coordinates;
  for (const ParameterLaw& law : fit.layout->laws()) {
    if (fit.layout->names()[law.parameter].starts_with(effect + ".")) {
      for (std::size_t k = 0; k < law.count(); ++k) {
        coordinates.push_back(law.first + k);
      }
      break;
    }
  }
  return coordinates;
}

Fit at_neutral_size(const Workbench& bench, const Fit& fit, const std::string& effect) {
  const Fit neutral = bench.with_neutral(fit, effect);
  const std::vector<std::size_t> size = size_of(neutral, effect);
  const auto runs = [&](const Fit& shape) {
    const double sense = shape.point[size.front()] > 0.5 ? -1.0 : 1.0;
    return stacked(bench, moved(shape, size, sense * effect_sizes.front())).allFinite();
  };
  if (size.empty() || runs(neutral)) {
    return neutral;
  }
  const Starts starts = bench.starts(neutral.what, fit);
  for (const std::vector<double>& start : starts.points) {
    Fit shape = neutral;
    shape.point = start;
    for (const std::size_t c : starts.sizes) {
      shape.point[c] = neutral.point[c];
    }
    shape.terms = shape.layout->terms(shape.point);
    if (runs(shape)) {
      return shape;
    }
  }
  return neutral;
}

}  // namespace hysteron
