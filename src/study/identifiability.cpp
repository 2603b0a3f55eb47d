#include "study/identifiability.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "fit/curvature_directions.hpp"
#include "fit/driver.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/identify.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr double chi_squared_95 = 3.841458820694124;  // one degree of freedom
constexpr int steps = 5;                              // of a profile, to either side
constexpr std::size_t descent = 40;  // iterations allowed to a descent from the best run, to a refit the half

struct Point {
  std::vector<double> u;
  double cost = 0.0;
};

// Levenberg-Marquardt from `start` with one coordinate held where it is, or none.
Point descend(const Objective& objective, const std::vector<double>& start, std::optional<std::size_t> held,
              std::size_t iterations) {
  const std::size_t d = start.size();
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < d; ++k) {
    if (k != held) free.push_back(k);
  }
  const std::size_t m = free.size();
  if (m == 0) return {start, objective.evaluate({start, false}).cost[0]};
  const auto whole = [&](const double* some) {
    std::vector<double> u = start;
    for (std::size_t k = 0; k < m; ++k) u[free[k]] = some[k];
    return u;
  };
  Problem problem;
  problem.dimension = m;
  problem.budget = iterations * (1 + m);
  problem.linear.assign(m, false);
  for (const std::size_t k : free) problem.start.push_back(start[k]);
  const RunResult result = run_solver(*find_solver("lm"), problem, [&](const Request& request) {
    const std::size_t count = request.points.size() / m;
    Request full{{}, request.derivatives};
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<double> u = whole(request.points.data() + k * m);
      full.points.insert(full.points.end(), u.begin(), u.end());
    }
    const Response answer = objective.evaluate(full);
    Response response{answer.cost, {}, {}, {}, {}};
    if (!request.derivatives) return response;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < m; ++i) {
        response.gradient.push_back(answer.gradient[k * d + free[i]]);
        for (std::size_t j = 0; j < m; ++j) {
          response.gauss_newton.push_back(answer.gauss_newton[(k * d + free[i]) * d + free[j]]);
        }
      }
    }
    return response;
  });
  const double own = objective.evaluate({start, false}).cost[0];
  if (result.best.size() != m || result.cost > own) return {start, own};
  return {whole(result.best.data()), result.cost};
}

std::string name_of(const Layout& layout, std::size_t c) {
  const Coordinate& coordinate = layout.coordinates()[c];
  std::string name = layout.names()[coordinate.parameter];
  for (const ParameterLaw& law : layout.laws()) {
    if (law.parameter == coordinate.parameter && law.count() > 1) {
      return name + "[" + std::to_string(coordinate.node + 1) + "]";
    }
  }
  return name;
}

// Where a profile crosses the threshold on one side, between two of its points; none where it does not.
std::optional<double> crossing(const std::vector<std::pair<double, double>>& side, double threshold) {
  for (std::size_t k = 1; k < side.size(); ++k) {
    if (side[k].second < threshold) continue;
    const double share = (threshold - side[k - 1].second) / (side[k].second - side[k - 1].second);
    return side[k - 1].first + share * (side[k].first - side[k - 1].first);
  }
  return {};
}

class Winner {
 public:
  Winner(const Plan& plan, const StudyProblem& problem, const std::vector<double>& best)
      : layout_(problem.layout), objective_(problem.layout, problem.recordings, options(plan)) {
    at_ = descend(objective_, best, {}, descent);
    const std::size_t d = at_.u.size();
    for (const Eigen::Index k : free_coordinates(at_.u)) free_.push_back(static_cast<std::size_t>(k));
    const double r = residual_correlation(objective_, layout_.terms(at_.u));
    effective_ =
        std::max(static_cast<double>(objective_.samples()) * (1.0 - r) / (1.0 + r) - static_cast<double>(d), 1.0);
    // -2 log of the likelihood ratio is N log(cost^2 / best^2) where the noise is not known beforehand.
    threshold_ = at_.cost * std::exp(0.5 * chi_squared_95 / effective_);
  }

  json run(const std::function<bool()>& stop) {
    const Response response = objective_.evaluate({at_.u, true});
    const auto d = static_cast<Eigen::Index>(at_.u.size());
    const Eigen::Map<const Eigen::MatrixXd> full(response.gauss_newton.data(), d, d);
    json result = {{"nrmse", at_.cost}, {"threshold", threshold_},      {"effective_samples", effective_},
                   {"free", free_},     {"correlation", json::array()}, {"spectrum", json::array()}};
    correlations(full, result);
    spectrum(full, result);
    json rows = json::array();
    for (std::size_t c = 0; c < at_.u.size(); ++c) {
      if (stop && stop()) return {};
      rows.push_back(parameter(c));
    }
    result["parameters"] = std::move(rows);
    return result;
  }

 private:
  static ObjectiveOptions options(const Plan& plan) {
    ObjectiveOptions result = plan.study.objective;
    result.threads = 1;
    return result;
  }

  [[nodiscard]] std::vector<Eigen::Index> indices() const { return {free_.begin(), free_.end()}; }

  void correlations(const Eigen::Ref<const Eigen::MatrixXd>& full, json& result) {
    const auto m = static_cast<Eigen::Index>(free_.size());
    deviation_.assign(at_.u.size(), 1.0);
    if (m == 0) return;
    const CorrelationEigen eigen(full(indices(), indices()));
    const Eigen::MatrixXd covariance = eigen.inverse();
    const Eigen::MatrixXd correlation = correlation_of(covariance);
    const double variance = at_.cost * at_.cost / effective_;
    for (Eigen::Index i = 0; i < m; ++i) {
      json row = json::array();
      for (Eigen::Index j = 0; j < m; ++j) {
        row.push_back(correlation(i, j));
      }
      result["correlation"].push_back(row);
      deviation_[free_[static_cast<std::size_t>(i)]] =
          std::min(1.0, std::sqrt(variance * covariance(i, i)) / eigen.norm[i]);
    }
  }

  void spectrum(const Eigen::Ref<const Eigen::MatrixXd>& full, json& result) const {
    const auto m = static_cast<Eigen::Index>(free_.size());
    if (m == 0) return;
    Eigen::VectorXd scale(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const std::size_t c = free_[static_cast<std::size_t>(i)];
      const Coordinate& coordinate = layout_.coordinates()[c];
      scale[i] = coordinate.lower >= 0.0 ? layout_.physical(c, at_.u[c]) / layout_.slope(c, at_.u[c]) : 1.0;
    }
    const Eigen::MatrixXd relative = scale.asDiagonal() * full(indices(), indices()) * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(relative);
    const double largest = std::max(solver.eigenvalues()[m - 1], 1e-300);
    for (Eigen::Index e = m - 1; e >= 0; --e) {
      json parts = json::array();
      for (Eigen::Index i = 0; i < m; ++i) {
        if (std::fabs(solver.eigenvectors()(i, e)) >= 0.3) {
          parts.push_back({{"parameter", free_[static_cast<std::size_t>(i)]}, {"weight", solver.eigenvectors()(i, e)}});
        }
      }
      result["spectrum"].push_back(
          {{"eigenvalue", std::max(solver.eigenvalues()[e] / largest, 1e-17)}, {"parts", parts}});
    }
  }

  // Points of one side, outward, each from the one before, until well above the threshold or at the end of the box.
  [[nodiscard]] std::vector<std::pair<double, double>> side(std::size_t c, double end) const {
    std::vector<std::pair<double, double>> points{{at_.u[c], at_.cost}};
    std::vector<double> u = at_.u;
    for (int k = 1; k <= steps; ++k) {
      u[c] = at_.u[c] + (end - at_.u[c]) * k / steps;
      const Point point = descend(objective_, u, c, descent / 2);
      u = point.u;
      points.emplace_back(u[c], point.cost);
      if (point.cost > at_.cost + 4.0 * (threshold_ - at_.cost)) break;
    }
    return points;
  }

  [[nodiscard]] json parameter(std::size_t c) const {
    const Coordinate& coordinate = layout_.coordinates()[c];
    const double u = at_.u[c];
    json row = {{"name", name_of(layout_, c)},
                {"unit", std::string(layout_.cards()[coordinate.parameter].unit)},
                {"value", layout_.physical(c, u)},
                {"lower", coordinate.lower},
                {"upper", coordinate.upper},
                {"log", coordinate.scale == Scale::logarithmic},
                {"at_bound", on_bound(u) ? json(u < 0.5 ? "lower" : "upper") : json(nullptr)}};
    // Three standard deviations to either side, or to the end of the box.
    const double reach = 3.0 * std::max(deviation_[c], 1e-4);
    const auto down = side(c, std::max(0.0, u - reach));
    const auto up = side(c, std::min(1.0, u + reach));
    json values = json::array();
    json costs = json::array();
    const auto put = [&](const std::pair<double, double>& point) {
      values.push_back(layout_.physical(c, point.first));
      costs.push_back(point.second);
    };
    for (std::size_t k = down.size(); k-- > 1;) put(down[k]);
    for (const auto& point : up) put(point);
    row["profile"] = {{"value", values}, {"nrmse", costs}};
    const auto low = on_bound(u) && u < 0.5 ? std::nullopt : crossing(down, threshold_);
    const auto high = on_bound(u) && u > 0.5 ? std::nullopt : crossing(up, threshold_);
    row["low"] = low ? json(layout_.physical(c, *low)) : json(nullptr);
    row["high"] = high ? json(layout_.physical(c, *high)) : json(nullptr);
    return row;
  }

  const Layout& layout_;
  Objective objective_;
  Point at_;
  std::vector<std::size_t> free_;
  std::vector<double> deviation_;  // of unit coordinates
  double effective_ = 1.0;
  double threshold_ = 0.0;
};

}  // namespace

std::vector<const RunRecord*> best_runs(const json& plan, const std::vector<RunRecord>& records) {
  std::map<std::string, const RunRecord*> by_key;
  for (const RunRecord& record : records) by_key[record.key] = &record;
  std::vector<const RunRecord*> best(plan.at("problems").size(), nullptr);
  for (const json& run : plan.at("runs")) {
    const auto found = by_key.find(run.at("key").get<std::string>());
    if (found == by_key.end() || !found->second->nrmse) continue;
    const RunRecord*& so_far = best[run.at("problem").get<std::size_t>()];
    if (so_far == nullptr || *found->second->nrmse < *so_far->nrmse) so_far = found->second;
  }
  return best;
}

json identifiability(const Plan& plan, const std::vector<RunRecord>& records, int threads,
                     const std::function<bool()>& stop) {
  const json planned = plan_json(plan);
  const std::vector<const RunRecord*> best = best_runs(planned, records);
  std::vector<json> rows(best.size());
  parallel_for(best.size(), threads, [&](std::size_t p) {
    if (best[p] == nullptr || (stop && stop())) return;
    rows[p] = Winner(plan, plan.problems[p], best[p]->best).run(stop);
    if (!rows[p].is_null()) rows[p]["key"] = best[p]->key;
  });
  if (stop && stop()) return {{"schema", "hysteron.identifiability/1"}, {"problems", nullptr}};
  return {{"schema", "hysteron.identifiability/1"}, {"problems", rows}};
}

}  // namespace hysteron
