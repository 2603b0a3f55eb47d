#include "diagnose/search/alias.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/search/signature.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr double least_change = 0.01;  // of the peak force, root mean square, at which an effect is compared
// What is left of a change beside the parameters of the fit is no more than their curvature below this part of it.
constexpr double least_left = 0.03;
constexpr double interior = 1e-3;  // of the box: nearer to its end than this is the end

// What the effect adds to the force beside the basis, of length one; empty where it adds nothing of its own.
std::optional<Eigen::VectorXd> signature(const Workbench& bench, const Fit& fit, const std::string& effect,
                                         const Eigen::VectorXd& at, const Eigen::MatrixXd& basis) {
  const Fit neutral = at_neutral_size(bench, fit, effect);
  const std::vector<std::size_t> coordinates = size_of(neutral, effect);
  if (coordinates.empty()) {
    return std::nullopt;
  }
  const double sense = neutral.point[coordinates.front()] > 0.5 + interior ? -1.0 : 1.0;
  for (const double size : effect_sizes) {
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
  parallel_for(effects.size(), bench.options().threads,
               [&](std::size_t k) { signatures[k] = signature(bench, fit, effects[k], at, basis); });
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
