#include "diagnose/search/alias.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// Parts of the box of an effect's first parameter, off its neutral value, to try one after the other.
constexpr std::array<double, 8> sizes = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8};
constexpr double least_change = 0.01;
// What is left of a change beside the parameters of the fit is no more than their curvature below this part of it.
constexpr double least_left = 0.03;
constexpr double nudge = 1e-3;
constexpr double rank_tolerance = 1e-9;

// Residuals of all fitted recordings over their norms, the run-in left out.
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

// An orthonormal basis of what the parameters of the fit can do, to first order.
Eigen::MatrixXd imitable(const Workbench& bench, const Fit& fit, const Eigen::VectorXd& at) {
  Eigen::MatrixXd slopes(at.size(), static_cast<Eigen::Index>(fit.dimension()));
  parallel_for(fit.dimension(), 0, [&](std::size_t c) {
    const double by = fit.point[c] > 0.5 ? -nudge : nudge;
    slopes.col(static_cast<Eigen::Index>(c)) = (stacked(bench, moved(fit, {c}, by)) - at) / by;
  });
  for (Eigen::Index c = 0; c < slopes.cols(); ++c) {
    const double norm = slopes.col(c).norm();
    slopes.col(c) =
        std::isfinite(norm) && norm > 0.0 ? (slopes.col(c) / norm).eval() : Eigen::VectorXd::Zero(at.size());
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(slopes);
  qr.setThreshold(rank_tolerance);
  return qr.householderQ() * Eigen::MatrixXd::Identity(at.size(), qr.rank());
}

// What the effect adds to the force beside the basis, of length one; empty where it adds nothing of its own.
std::optional<Eigen::VectorXd> signature(const Workbench& bench, const Fit& fit, const std::string& effect,
                                         const Eigen::VectorXd& at, const Eigen::MatrixXd& basis) {
  const Fit neutral = bench.with_neutral(fit, effect);
  std::vector<std::size_t> coordinates;
  for (const ParameterLaw& law : neutral.layout->laws()) {
    if (neutral.layout->names()[law.parameter].starts_with(effect + ".")) {
      for (std::size_t k = 0; k < law.drive_nodes.size() * law.frequency_nodes.size(); ++k) {
        coordinates.push_back(law.first + k);
      }
      break;
    }
  }
  if (coordinates.empty()) {
    return std::nullopt;
  }
  const double sense = neutral.point[coordinates.front()] > 0.5 + nudge ? -1.0 : 1.0;
  for (const double size : sizes) {
    const Eigen::VectorXd change = stacked(bench, moved(neutral, coordinates, sense * size)) - at;
    const double norm = change.norm();
    if (!std::isfinite(norm)) {
      return std::nullopt;
    }
    if (norm < least_change * std::sqrt(static_cast<double>(at.size()))) {
      continue;
    }
    const Eigen::VectorXd left = change - basis * (basis.transpose() * change);
    if (left.norm() < least_left * norm) {
      return std::nullopt;
    }
    return left.normalized();
  }
  return std::nullopt;
}

}  // namespace

AliasMap alias_map(const Workbench& bench, const Fit& fit, const std::vector<std::string>& effects) {
  const Eigen::VectorXd at = stacked(bench, fit);
  AliasMap result;
  if (at.size() <= static_cast<Eigen::Index>(fit.dimension()) || !at.allFinite()) {
    return result;
  }
  const Eigen::MatrixXd basis = imitable(bench, fit, at);
  std::vector<std::optional<Eigen::VectorXd>> signatures(effects.size());
  parallel_for(effects.size(), 0, [&](std::size_t k) { signatures[k] = signature(bench, fit, effects[k], at, basis); });
  std::vector<Eigen::VectorXd> own;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (signatures[k]) {
      result.effects.push_back(effects[k]);
      own.push_back(*signatures[k]);
    }
  }
  for (const Eigen::VectorXd& a : own) {
    std::vector<double>& row = result.cosine.emplace_back();
    for (const Eigen::VectorXd& b : own) {
      row.push_back(&a == &b ? 1.0 : std::min(1.0, std::fabs(a.dot(b))));
    }
  }
  return result;
}

std::vector<AlikePair> alike_pairs(const AliasMap& map) {
  std::vector<AlikePair> result;
  for (std::size_t i = 0; i < map.effects.size(); ++i) {
    for (std::size_t j = i + 1; j < map.effects.size(); ++j) {
      if (map.cosine[i][j] >= alike_from) {
        result.push_back({map.effects[i], map.effects[j], map.cosine[i][j]});
      }
    }
  }
  std::ranges::stable_sort(result, [](const AlikePair& a, const AlikePair& b) { return a.cosine > b.cosine; });
  return result;
}

}  // namespace hysteron
