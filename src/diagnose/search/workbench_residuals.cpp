// What the fits of a workbench leave on its recordings.
#include <cmath>
#include <functional>

#include "diagnose/search/workbench.hpp"
#include "fit/parallel.hpp"
#include "fit/predict.hpp"
#include "fit/score.hpp"

namespace hysteron {

Residual Workbench::residual(const Fit& fit, const Recording& recording) const {
  // Recordings of the workbench are known by where they lie; others may be gone when the next one lies there.
  const std::vector<Recording>& own = split_->fit;
  const std::less<> before;
  if (own.empty() || before(&recording, own.data()) || !before(&recording, own.data() + own.size())) {
    return simulated(fit, recording);
  }
  ByteWriter key;
  add_parameters(key, fit);
  key.whole(static_cast<std::uint64_t>(&recording - own.data()));
  return residuals_->get(key.bytes(), [&] { return simulated(fit, recording); });
}

Residual Workbench::simulated(const Fit& fit, const Recording& recording) const {
  const Target target = make_target(recording, options_);
  Residual result{predict(fit.layout->model(), fit.layout->held(), fit.terms, target), target.run_in};
  for (std::size_t n = 0; n < result.force.size(); ++n) {
    result.force[n] = n < result.from ? 0.0 : result.force[n] - recording.force[n];
  }
  return result;
}

std::vector<Residual> Workbench::plain_residuals(const Fit& fit) const {
  std::vector<Residual> result(split_->fit.size());
  parallel_for(result.size(), options_.threads, [&](std::size_t k) { result[k] = residual(fit, split_->fit[k]); });
  return result;
}

Residuals Workbench::residuals(const Fit& fit) const {
  const std::vector<Recording>& recordings = split_->fit;
  Residuals result;
  result.of.resize(recordings.size());
  result.passed_on.resize(recordings.size());
  result.noise = noise_;
  for (const Recording& recording : recordings) {
    result.norms.push_back(normaliser(recording, options_.normalisation));
  }
  std::vector<Residual> shaken_too(recordings.size());
  parallel_for(2 * recordings.size(), options_.threads, [&](std::size_t task) {
    const std::size_t k = task / 2;
    if (task % 2 == 0) {
      result.of[k] = residual(fit, recordings[k]);
    } else {
      shaken_too[k] = residual(fit, shaken(recordings[k]));
    }
  });
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    // Both are compared with the same recorded force: the difference is that of the simulated ones.
    Residual& change = shaken_too[k];
    change.from = std::max(change.from, result.of[k].from);
    for (std::size_t n = 0; n < change.force.size(); ++n) {
      change.force[n] -= result.of[k].force[n];
    }
    result.passed_on[k] = change.mean_square();
  }
  return result;
}

std::vector<Sensitivity> Workbench::sensitivities(const Fit& fit, const Residuals& residuals) const {
  constexpr double step = 1e-3;  // relative, of the parameter
  std::vector<Sensitivity> result;
  for (const ParameterLaw& law : fit.layout->laws()) {
    const std::string& name = fit.layout->names()[law.parameter];
    // Of what may be zero no relative change can be told.
    if (name.find('.') != std::string::npos || fit.layout->cards()[law.parameter].box.lower < 0.0) {
      continue;
    }
    Fit moved = fit;
    for (Term& term : moved.terms) {
      if (term.parameter == law.parameter) {
        term.value *= 1.0 + step;
      }
    }
    Sensitivity row{name, std::vector<std::vector<double>>(split_->fit.size())};
    parallel_for(split_->fit.size(), options_.threads, [&](std::size_t k) {
      row.slope[k] = residual(moved, split_->fit[k]).force;
      for (std::size_t n = 0; n < row.slope[k].size(); ++n) {
        row.slope[k][n] = (row.slope[k][n] - residuals.of[k].force[n]) / step;
      }
    });
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace hysteron
