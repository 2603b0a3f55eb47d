#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/unit_text.hpp"
#include "fit/bounds_met.hpp"
#include "fit/curvature_directions.hpp"
#include "fit/estimate_blocks.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/identify.hpp"
#include "fit/jackknife.hpp"
#include "fit/march_target.hpp"
#include "fit/neighbours.hpp"

namespace hysteron {
namespace {

constexpr double normal_quantile = 1.96;

// Of the terms of a layout.
struct Uncertainty {
  std::vector<bool> open;          // coordinates of which nothing can be said
  std::vector<Eigen::Index> free;  // those off their bounds
  Eigen::MatrixXd to_terms;        // derivatives of the terms
  Eigen::VectorXd std_error;
  Eigen::VectorXd half_width;
  Eigen::VectorXd per_misfit;
};

}  // namespace

// Lag-1 correlation of the residuals, pooled: a coloured residual carries fewer independent samples than it has.
double residual_correlation(const Objective& objective, const std::vector<Term>& terms) {
  NeighbourCorrelation pooled;
  for (const Target& target : objective.targets()) {
    std::vector<double> residual = predict(objective.layout().model(), objective.layout().held(), terms, target);
    for (std::size_t n = 0; n < residual.size(); ++n) {
      residual[n] = (residual[n] - target.force[n]) / target.normaliser;
    }
    pooled.add(residual);
  }
  return pooled.value();
}

namespace {

// Where nothing was worked out.
Uncertainty unknown(std::size_t dimension) {
  const auto d = static_cast<Eigen::Index>(dimension);
  return {std::vector<bool>(dimension, false),
          {},
          Eigen::MatrixXd::Zero(d, d),
          Eigen::VectorXd::Zero(d),
          Eigen::VectorXd::Zero(d),
          Eigen::VectorXd::Zero(d)};
}

// Without any derivative nothing is known, least of all that the data leave all parameters open.
bool without_derivatives(const Layout& layout, const Response& response) {
  for (std::size_t k = 0; k < layout.dimension(); ++k) {
    if (std::isfinite(response.gauss_newton[k * (layout.dimension() + 1)])) return false;
  }
  return true;
}

constexpr const char* no_derivatives =
    "no standard errors: the derivatives of the simulation are not finite at these parameters";

// Standard errors and 95 % intervals: the widest of the following and of what the jackknife says.
// From the Gauss-Newton matrix at the optimum, free coordinates only, with the effective sample size
// N (1 - r) / (1 + r) of residuals whose lag-1 correlation is r. Directions the data leave open make the parameters
// in them unidentifiable; they are looked for among all coordinates, since a parameter whose partner in a redundant
// pair sits on a bound is no better determined.
// `spreads`: the jackknife of the point over its free coordinates, where it can be had.
template <class Spreads>
Uncertainty uncertainty_of(const Layout& layout, const Response& response, double independent,
                           const std::vector<double>& u, const Spreads& spreads_of) {
  const auto d = static_cast<Eigen::Index>(layout.dimension());
  Eigen::MatrixXd full = Eigen::Map<const Eigen::MatrixXd>(response.gauss_newton.data(), d, d);
  std::vector<bool> open(static_cast<std::size_t>(d), false);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < d; ++k) {
    if (!std::isfinite(full(k, k))) {
      // Of a coordinate without a finite derivative nothing can be said; the others keep their errors.
      full.row(k).setZero();
      full.col(k).setZero();
      open[static_cast<std::size_t>(k)] = true;
    } else if (!on_bound(u[static_cast<std::size_t>(k)])) {
      free.push_back(k);
    }
  }
  const auto m = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(d, d);
  const double variance = response.cost[0] * response.cost[0] / std::max(independent - static_cast<double>(m), 1.0);
  const CorrelationEigen all(full);
  for (Eigen::Index e = 0; e < d; ++e) {
    for (Eigen::Index i = 0; i < d && all.open(e); ++i) {
      if (std::fabs(all.vectors(i, e)) > 0.1) {
        open[static_cast<std::size_t>(i)] = true;
      }
    }
  }
  if (m > 0) {
    const CorrelationEigen eigen(full(free, free));
    const Eigen::MatrixXd told = eigen.told_inverse();
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto a = free[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < m; ++j) {
        inverse(a, free[static_cast<std::size_t>(j)]) = told(i, j) / (eigen.norm[i] * eigen.norm[j]);
      }
      // An interval as wide as the box says nothing.
      if (eigen.norm[i] <= 1e-150 || 4.0 * std::sqrt(variance * inverse(a, a)) > 1.0) {
        open[static_cast<std::size_t>(a)] = true;
      }
    }
  }
  Eigen::MatrixXd to_terms(d, d);
  const std::vector<double> matrix = layout.term_matrix();
  for (Eigen::Index t = 0; t < d; ++t) {
    for (Eigen::Index c = 0; c < d; ++c) {
      to_terms(t, c) = matrix[static_cast<std::size_t>(t * d + c)] *
                       layout.slope(static_cast<std::size_t>(c), u[static_cast<std::size_t>(c)]);
    }
  }
  const Eigen::MatrixXd of_terms = to_terms * inverse * to_terms.transpose();
  const Eigen::VectorXd per_misfit = of_terms.diagonal().cwiseMax(0.0).cwiseSqrt();
  Eigen::VectorXd std_error = std::sqrt(variance) * per_misfit;
  Eigen::VectorXd half_width = normal_quantile * std_error;
  if (m > 0 && response.cost[0] < diverged_cost) {
    const Eigen::MatrixXd free_to_terms = to_terms(Eigen::all, free);
    const auto deviation = [&](const Spread& spread) -> Eigen::VectorXd {
      return (free_to_terms * spread.covariance * free_to_terms.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
    };
    const std::optional<Jackknife> spreads = spreads_of(free);
    if (spreads) {
      std_error = std_error.cwiseMax(deviation(spreads->stretches));
      half_width = half_width.cwiseMax(spreads->stretches.quantile * deviation(spreads->stretches));
    }
    // Few recordings tell their own spread badly, which the wide quantile allows for and a standard error cannot.
    if (spreads && spreads->recordings) {
      half_width = half_width.cwiseMax(spreads->recordings->quantile * deviation(*spreads->recordings));
    }
  }
  return {open, free, to_terms, std_error, half_width, per_misfit};
}

}  // namespace

std::optional<Interval> interval_of(const Term& term, const Parameter& card, double half_width) {
  const double value = term.value;
  Interval interval{value - half_width, value + half_width};
  if (!term.constant()) return interval;
  if (card.scale == Scale::logarithmic && value > 0.0) {
    const double factor = std::exp(half_width / value);
    interval = {value / factor, value * factor};
  }
  if (interval.lower <= card.box.lower && interval.upper >= card.box.upper) return std::nullopt;
  return Interval{std::max(interval.lower, card.limits.lower), std::min(interval.upper, card.limits.upper)};
}

namespace {

void add_estimates(Identification& result, const Uncertainty& uncertainty, const std::vector<double>& u,
                   DriveKind drive_kind) {
  const Layout& layout = result.layout;
  for (const ParameterLaw& law : layout.laws()) {
    const std::size_t count = law.count();
    bool law_open = false;
    bool law_free = false;
    std::optional<BoxEnd> bound;
    bool limit = true;
    for (std::size_t k = 0; k < count; ++k) {
      const double position = u[law.first + k];
      law_open = law_open || uncertainty.open[law.first + k];
      if (on_bound(position)) {
        bound = on_upper(position) ? BoxEnd::upper : BoxEnd::lower;
        limit = limit && is_limit(layout.cards()[law.parameter], on_upper(position));
      } else {
        law_free = true;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t t = law.first + k;
      const Term& term = result.terms[t];
      const Parameter& card = layout.cards()[law.parameter];
      Estimate estimate;
      estimate.term = term;
      estimate.name = term_name(layout.names()[law.parameter], term, layout.conditions());
      estimate.unit = term_unit(card.unit, term, layout.conditions(), drive_kind);
      estimate.unit_text = term_unit_text(card.unit, term, layout.conditions(), drive_kind);
      estimate.meaning = std::string(card.meaning);
      estimate.lower = card.box.lower;
      estimate.upper = card.box.upper;
      estimate.at_bound = bound;
      estimate.at_limit = bound && limit;
      estimate.identifiable = !law_open;
      const auto row = static_cast<Eigen::Index>(t);
      // A term all of whose nodes sit on bounds has no error to state, not the error zero.
      bool determined = false;
      for (const Eigen::Index c : uncertainty.free) {
        determined = determined || uncertainty.to_terms(row, c) != 0.0;
      }
      if (!law_open && law_free && determined && std::isfinite(uncertainty.half_width[row])) {
        estimate.std_error = uncertainty.std_error[row];
        estimate.half_width = uncertainty.half_width[row];
        estimate.per_misfit = uncertainty.per_misfit[row];
        estimate.ci95 = interval_of(term, card, uncertainty.half_width[row]);
      }
      result.estimates.push_back(std::move(estimate));
    }
  }
}

}  // namespace

// Its derivatives, and once more for the jackknife.
std::size_t blocks_of_estimate(const Objective& objective) {
  constexpr auto directions = static_cast<std::size_t>(sweep_directions);
  constexpr auto lanes = static_cast<std::size_t>(lane_count);
  const std::size_t sweeps = (objective.layout().dimension() + directions - 1) / directions;
  const std::size_t groups = (sweeps + lanes - 1) / lanes;
  std::size_t blocks = 0;
  for (const Target& target : objective.targets()) {
    blocks += (target.force.size() + block_samples - 1) / block_samples;
  }
  return 2 * groups * blocks;
}

void estimate(Identification& result, const Objective& objective, const std::vector<double>& u, DriveKind drive_kind) {
  Uncertainty uncertainty = unknown(result.layout.dimension());
  try {
    const double r = residual_correlation(objective, result.terms);
    const Response derivatives = objective.evaluate({u, true});
    result.correlations = correlations(derivatives, u);
    result.sensitivities = sensitivities(objective.layout(), derivatives, measured_square(objective.targets()), u);
    result.bounds_met = bounds_text(objective.layout(), derivatives, u, drive_kind);
    if (without_derivatives(objective.layout(), derivatives)) {
      result.warnings.emplace_back(no_derivatives);
    } else {
      uncertainty = uncertainty_of(
          objective.layout(), derivatives, static_cast<double>(objective.samples()) * (1.0 - r) / (1.0 + r), u,
          [&](const std::vector<Eigen::Index>& free) { return jackknife(objective, u, free); });
    }
  } catch (const Stopped&) {
    result.warnings.emplace_back("interrupted before the standard errors were worked out");
  }
  add_estimates(result, uncertainty, u, drive_kind);
}

void estimate(Identification& result, const Response& derivatives, double independent, const std::vector<double>& u,
              DriveKind drive_kind) {
  result.correlations = correlations(derivatives, u);
  result.bounds_met = bounds_text(result.layout, derivatives, u, drive_kind);
  Uncertainty uncertainty = unknown(result.layout.dimension());
  if (without_derivatives(result.layout, derivatives)) {
    result.warnings.emplace_back(no_derivatives);
  } else {
    uncertainty = uncertainty_of(result.layout, derivatives, independent, u,
                                 [](const std::vector<Eigen::Index>&) { return std::optional<Jackknife>(); });
  }
  add_estimates(result, uncertainty, u, drive_kind);
}

}  // namespace hysteron
