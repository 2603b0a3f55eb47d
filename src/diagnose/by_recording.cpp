#include "diagnose/by_recording.hpp"

#include <algorithm>
#include <cmath>

#include "core/squared.hpp"
#include "fit/parallel.hpp"

namespace hysteron {

std::vector<Handle> handles_of(const Fit& fit) {
  std::vector<Handle> result;
  for (const ParameterLaw& law : fit.layout->laws()) {
    const bool of_the_law = fit.layout->names()[law.parameter].find('.') == std::string::npos;
    const PhysicalRole role = fit.layout->cards()[law.parameter].role;
    if (of_the_law && (fit.layout->coordinates()[law.first].linear || role != PhysicalRole::none)) {
      result.push_back({law.parameter, law.count() > 1});
    }
  }
  return result;
}

Fit moved(const Fit& fit, const Handle& handle, double step) {
  Fit result = fit;
  for (Term& term : result.terms) {
    if (term.parameter == handle.parameter && handle.factor) {
      term.value *= 1.0 + step;
    } else if (term.parameter == handle.parameter && term.constant()) {
      term.value += step;
    }
  }
  return result;
}

std::vector<Quadratic> quadratics_of(const Workbench& bench, const Fit& fit, const std::vector<Handle>& handles) {
  constexpr double part_of_the_box = 1e-3;
  const std::vector<Recording>& recordings = bench.split().fit;
  std::vector<Quadratic> result(recordings.size());
  parallel_for(recordings.size(), bench.options().threads, [&](std::size_t r) {
    const Residual left = bench.residual(fit, recordings[r]);
    const auto rows = static_cast<Eigen::Index>(left.force.size());
    Eigen::MatrixXd slopes(rows, static_cast<Eigen::Index>(handles.size()));
    for (std::size_t h = 0; h < handles.size(); ++h) {
      const Parameter& card = fit.layout->cards()[handles[h].parameter];
      const double step = handles[h].factor ? part_of_the_box : part_of_the_box * (card.box.upper - card.box.lower);
      const Residual there = bench.residual(moved(fit, handles[h], step), recordings[r]);
      for (Eigen::Index n = 0; n < rows; ++n) {
        const auto k = static_cast<std::size_t>(n);
        slopes(n, static_cast<Eigen::Index>(h)) = (there.force[k] - left.force[k]) / step;
      }
    }
    const Eigen::Map<const Eigen::VectorXd> force(left.force.data(), rows);
    const double norm = normaliser(recordings[r], bench.options().normalisation);
    const double weight = 1.0 / (squared(norm) * static_cast<double>(rows - static_cast<Eigen::Index>(left.from)) *
                                 static_cast<double>(recordings.size()));
    result[r] = {weight * slopes.transpose() * slopes, weight * slopes.transpose() * force,
                 weight * force.squaredNorm()};
  });
  return result;
}

bool finite(const std::vector<Quadratic>& quadratics) {
  return std::ranges::all_of(quadratics, [](const Quadratic& row) {
    return row.hessian.allFinite() && row.gradient.allFinite() && std::isfinite(row.squares);
  });
}

ByRecording by_recording(const Workbench& bench, const Fit& base) {
  ByRecording result;
  result.joint = bench.polished(base, descent_rounds);
  result.handles = handles_of(result.joint);
  result.quadratics = quadratics_of(bench, result.joint, result.handles);
  return result;
}

}  // namespace hysteron
