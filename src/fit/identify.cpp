#include "fit/identify.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace hysteron {
namespace {

// Eigenvalues and vectors of the Gauss-Newton matrix of some coordinates, scaled to unit diagonal.
struct CorrelationEigen {
  Eigen::VectorXd norm;
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;

  CorrelationEigen(const Eigen::Ref<const Eigen::MatrixXd>& full, const std::vector<Eigen::Index>& coordinates) {
    const Eigen::MatrixXd some = full(coordinates, coordinates);
    norm = some.diagonal().cwiseMax(1e-300).cwiseSqrt();
    const Eigen::MatrixXd scaled = norm.cwiseInverse().asDiagonal() * some * norm.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
  }
  // The data say nothing of this direction.
  [[nodiscard]] bool open(Eigen::Index direction) const { return values[direction] <= 1e-9; }
};

std::string final_stage(bool refit) {
  return refit ? "final fit on all recordings" : "final descent on the same recordings";
}

}  // namespace

double residual_correlation(const Objective& objective, const std::vector<Term>& terms) {
  double product = 0.0;
  double square = 0.0;
  for (const Target& target : objective.targets()) {
    const std::vector<double> force = predict(objective.layout().model(), objective.layout().held(), terms, target);
    double before = 0.0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      const double residual = (force[n] - target.force[n]) / target.normaliser;
      product += n > 0 ? residual * before : 0.0;
      square += residual * residual;
      before = residual;
    }
  }
  return square > 0.0 ? std::clamp(product / square, 0.0, 0.9999) : 0.0;
}

std::vector<Recording> pick(const std::vector<Recording>& recordings, const std::vector<std::size_t>& indices) {
  std::vector<Recording> result;
  for (const std::size_t index : indices) {
    result.push_back(recordings[index]);
  }
  return result;
}

double predicted_nrmse(const Layout& layout, const std::vector<Term>& terms, const std::vector<Recording>& recordings,
                       const ObjectiveOptions& options) {
  std::vector<Score> scores;
  for (const Recording& recording : recordings) {
    const Target target = make_target(recording, options);
    scores.push_back(score(predict(layout.model(), layout.held(), terms, target), recording, options.normalisation));
  }
  return overall(scores, recordings, options.normalisation, options.weighting);
}

Problem make_problem(const Objective& objective, const SolverEntry& entry, const IdentifyOptions& options,
                     const std::string& stage, std::vector<double> start) {
  Problem problem;
  problem.dimension = objective.layout().dimension();
  problem.budget = options.budget;
  problem.stream = Stream(options.seed).child(stage).child(entry.id);
  problem.linear = objective.layout().linear();
  problem.start = std::move(start);
  problem.screening = true;
  objective.describe_data(problem);
  for (const auto& [name, value] : options.settings) {
    const bool known = std::ranges::any_of(entry.settings, [&](const Setting& row) { return row.name == name; });
    if (known || options.solvers.size() == 1) {
      problem.settings[name] = value;
    }
  }
  return problem;
}

std::vector<std::size_t> choose_heldout(const std::vector<Recording>& recordings) {
  const std::size_t count = recordings.size();
  if (count < 4) {
    return {};
  }
  struct Key {
    double drive;
    double severity;
    std::size_t index;
  };
  std::vector<Key> keys;
  for (std::size_t k = 0; k < count; ++k) {
    const Recording& recording = recordings[k];
    double speed = 0.0;
    for (const double velocity : recording.velocity) {
      speed = std::max(speed, std::fabs(velocity));
    }
    keys.push_back({recording.drive.empty() ? 0.0 : recording.drive[recording.size() / 2], speed, k});
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) {
    return std::tie(a.drive, a.severity, a.index) < std::tie(b.drive, b.severity, b.index);
  });
  const std::size_t wanted = std::max<std::size_t>(1, count / 5);
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < wanted; ++k) {
    result.push_back(keys[(2 * k + 1) * count / (2 * wanted)].index);
  }
  std::ranges::sort(result);
  return result;
}

Identification identify(const Campaign& campaign, const std::string& model, const IdentifyOptions& options,
                        const Progress& progress) {
  std::vector<std::size_t> all(campaign.recordings.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> fitted;
  std::vector<std::size_t> heldout;
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role != Role::unassigned; });
  if (roles) {
    for (const std::size_t index : all) {
      (campaign.roles[index] == Role::validate ? heldout : fitted).push_back(index);
    }
    if (fitted.empty()) {
      throw InputError("campaign.toml: every recording has the role validate, expected at least one to fit");
    }
  } else {
    heldout = choose_heldout(campaign.recordings);
    std::ranges::set_difference(all, heldout, std::back_inserter(fitted));
  }
  std::vector<const SolverEntry*> entries;
  for (const std::string& id : options.solvers) {
    const SolverEntry* entry = find_solver(id);
    if (entry == nullptr) {
      throw InputError("unknown solver '" + id + "', see `hysteron list solvers`");
    }
    entries.push_back(entry);
  }
  // One box for both fits, so that a held-out check is of the same model.
  const DataScale scale = scale_of(pick(campaign.recordings, roles ? fitted : all));
  const Layout layout(make_model(model, options.effects), scale, options.layout);
  if (layout.dimension() == 0) {
    throw InputError("every parameter is fixed, expected at least one to identify");
  }
  Identification result{layout, {}, {}, {}, 0, 0.0, {}, fitted, heldout, roles, {}};

  const Objective objective(layout, pick(campaign.recordings, fitted), options.objective);
  std::vector<double> best;
  for (const SolverEntry* entry : entries) {
    const std::string stage = heldout.empty() || roles ? "fit" : "fit without the held-out recordings";
    RunResult run = run_solver(
        *entry, make_problem(objective, *entry, options, "fit", layout.initial()),
        [&](const Request& request) { return objective.evaluate(request); },
        [&](const RunResult& partial) {
          return !progress || progress(std::string(entry->id) + ": " + stage, partial);
        });
    if (run.best.empty() || run.cost >= diverged_cost) {
      throw WorkError("solver " + run.solver + " found no candidate whose simulation stays finite in " +
                      std::to_string(run.evaluations) + " evaluations");
    }
    SolverOutcome outcome{std::move(run), {}};
    if (!heldout.empty()) {
      outcome.nrmse_heldout = predicted_nrmse(layout, layout.terms(outcome.run.best),
                                              pick(campaign.recordings, heldout), options.objective);
    }
    result.solvers.push_back(std::move(outcome));
  }
  for (std::size_t k = 1; k < result.solvers.size(); ++k) {
    if (result.solvers[k].run.cost < result.solvers[result.chosen].run.cost) {
      result.chosen = k;
    }
  }
  best = result.solvers[result.chosen].run.best;
  result.nrmse_heldout = result.solvers[result.chosen].nrmse_heldout;
  result.cost = result.solvers[result.chosen].run.cost;

  const bool refit = !roles && !heldout.empty();
  const bool descends = entries[result.chosen]->uses_derivatives;
  const Objective final_objective(layout, pick(campaign.recordings, refit ? all : fitted), options.objective);
  if (refit || (!descends && result.solvers[result.chosen].run.stopped != "interrupted")) {
    // From what was found; other starts only where the chosen solver descends too. Without recordings to add, a solver
    // that does not descend still leaves the bottom of the valley to a descent.
    const SolverEntry* entry = find_solver(refit && descends ? "multistart-lm" : "lm");
    IdentifyOptions polish = options;
    polish.settings.clear();
    RunResult run = run_solver(
        *entry, make_problem(final_objective, *entry, polish, "refit", best),
        [&](const Request& request) { return final_objective.evaluate(request); },
        [&](const RunResult& partial) {
          return !progress || progress(std::string(entry->id) + ": " + final_stage(refit), partial);
        });
    if (refit || run.cost < result.cost) {
      best = run.best;
      result.cost = run.cost;
      if (!refit && !heldout.empty()) {
        result.nrmse_heldout =
            predicted_nrmse(layout, layout.terms(best), pick(campaign.recordings, heldout), options.objective);
      }
    }
    if (refit) {
      result.fitted = all;
    }
    result.final_stage = final_stage(refit);
    result.final_run = std::move(run);
  }
  result.terms = layout.terms(best);
  estimate(result, final_objective, best, campaign.recordings.front().drive_kind);

  // The winner once more with a tighter integration: a difference is the integrator's, not the model's.
  ObjectiveOptions tight = options.objective;
  tight.tolerance = options.objective.tolerance / 256.0;
  const double tight_cost =
      Objective(layout, pick(campaign.recordings, result.fitted), tight).evaluate({best, false}).cost[0];
  if (std::fabs(tight_cost - result.cost) > 1e-3 * result.cost) {
    result.warnings.push_back("a four times finer integration moves the NRMSE from " + std::to_string(result.cost) +
                              " to " + std::to_string(tight_cost) + ": use a smaller --tolerance");
  }
  for (const Estimate& estimate : result.estimates) {
    if (estimate.term.drive_power + estimate.term.frequency_power > 0) {
      continue;
    }
    if (estimate.at_bound) {
      result.warnings.push_back("parameter " + estimate.name + " sits on its " + *estimate.at_bound +
                                " bound: the data want it outside the box, or do not need it");
    }
    if (!estimate.identifiable) {
      result.warnings.push_back("parameter " + estimate.name + " is not identifiable from these recordings");
    }
  }
  return result;
}

// Standard errors from the Gauss-Newton matrix at the optimum, free coordinates only, with the effective sample size
// N (1 - r) / (1 + r) of residuals whose lag-1 correlation is r. Directions the data leave open make the parameters
// in them unidentifiable; they are looked for among all coordinates, since a parameter whose partner in a redundant
// pair sits on a bound is no better determined.
void estimate(Identification& result, const Objective& objective, const std::vector<double>& u, DriveKind drive_kind) {
  const Layout& layout = result.layout;
  const auto d = static_cast<Eigen::Index>(layout.dimension());
  Request request{u, true};
  const Response response = objective.evaluate(request);
  const Eigen::Map<const Eigen::MatrixXd> full(response.gauss_newton.data(), d, d);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < d; ++k) {
    const double position = u[static_cast<std::size_t>(k)];
    if (position > 1e-6 && position < 1.0 - 1e-6) {
      free.push_back(k);
    }
  }
  const auto m = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(d, d);
  std::vector<bool> open(static_cast<std::size_t>(d), false);
  std::vector<Eigen::Index> every(static_cast<std::size_t>(d));
  std::iota(every.begin(), every.end(), Eigen::Index{0});
  const CorrelationEigen all(full, every);
  for (Eigen::Index e = 0; e < d; ++e) {
    for (Eigen::Index i = 0; i < d && all.open(e); ++i) {
      if (std::fabs(all.vectors(i, e)) > 0.1) {
        open[static_cast<std::size_t>(i)] = true;
      }
    }
  }
  if (m > 0) {
    const CorrelationEigen eigen(full, free);
    const double r = residual_correlation(objective, result.terms);
    const double samples = static_cast<double>(objective.samples()) * (1.0 - r) / (1.0 + r);
    const double variance = response.cost[0] * response.cost[0] / std::max(samples - static_cast<double>(m), 1.0);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(m, m);
    for (Eigen::Index e = 0; e < m; ++e) {
      if (!eigen.open(e)) {
        inverse += eigen.vectors.col(e) * eigen.vectors.col(e).transpose() / eigen.values[e];
      }
    }
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto a = free[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < m; ++j) {
        covariance(a, free[static_cast<std::size_t>(j)]) = variance * inverse(i, j) / (eigen.norm[i] * eigen.norm[j]);
      }
      // An interval as wide as the box says nothing.
      if (eigen.norm[i] <= 1e-150 || 4.0 * std::sqrt(covariance(a, a)) > 1.0) {
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
  const Eigen::MatrixXd term_covariance = to_terms * covariance * to_terms.transpose();
  for (const ParameterLaw& law : layout.laws()) {
    const std::size_t count = law.drive_nodes.size() * law.frequency_nodes.size();
    bool law_open = false;
    bool law_free = false;
    std::optional<std::string> bound;
    for (std::size_t k = 0; k < count; ++k) {
      const double position = u[law.first + k];
      law_open = law_open || open[law.first + k];
      if (position <= 1e-6 || position >= 1.0 - 1e-6) {
        bound = position < 0.5 ? "lower" : "upper";
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
      estimate.name = term_name(layout.names()[law.parameter], term.drive_power, term.frequency_power);
      estimate.unit = std::string(card.unit);
      for (int power = 0; power < term.drive_power; ++power) {
        estimate.unit += drive_kind == DriveKind::voltage ? "/V" : "/A";
      }
      for (int power = 0; power < term.frequency_power; ++power) {
        estimate.unit += "/Hz";
      }
      estimate.meaning = std::string(card.meaning);
      estimate.lower = card.lower;
      estimate.upper = card.upper;
      estimate.at_bound = bound;
      estimate.identifiable = !law_open;
      const auto row = static_cast<Eigen::Index>(t);
      // A term all of whose nodes sit on bounds has no error to state, not the error zero.
      bool determined = false;
      for (const Eigen::Index c : free) {
        determined = determined || to_terms(row, c) != 0.0;
      }
      if (!law_open && law_free && determined) {
        estimate.std_error = std::sqrt(std::max(term_covariance(row, row), 0.0));
      }
      result.estimates.push_back(std::move(estimate));
    }
  }
}

}  // namespace hysteron
