// Identification of one parameter set over a campaign: held-out check, final fit, uncertainty.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "core/message.hpp"
#include "core/recording.hpp"
#include "fit/correlations.hpp"
#include "fit/driver.hpp"
#include "fit/objective.hpp"
#include "fit/sensitivity.hpp"
#include "simulate/knowledge.hpp"

namespace hysteron {

struct IdentifyOptions {
  std::vector<std::string> solvers{"multistart-lm"};  // the best result is kept
  std::size_t budget = 20000;
  std::uint64_t seed = 1;
  std::map<std::string, double> settings;  // of the solvers that know them
  ObjectiveOptions objective;
  LayoutOptions layout;
  std::vector<std::string> effects;
};

// An identified term with what the data say of it.
struct Estimate {
  Term term;
  std::string name;
  std::string unit;       // as stored
  std::string unit_text;  // as people read it
  std::string meaning;
  std::optional<double> std_error;   // absent when the data do not determine it
  std::optional<double> half_width;  // of the 95 % interval to first order, at least 1.96 std_error; absent likewise
  // How far a force that is not modelled moves the term for each unit of NRMSE that it has of the term's own shape,
  // what the other parameters imitate taken off. To first order; absent likewise.
  std::optional<double> per_misfit;
  // The 95 % interval: first order on the scale that the parameter is looked for on, cut where it can be no further.
  // Absent likewise, and of a constant where it holds the whole search range, which says nothing.
  std::optional<Interval> ci95;
  std::optional<BoxEnd> at_bound;  // the end of the box that a node value sits on
  bool at_limit = false;  // the bound is the end of what the parameter can be at all, not of its search range only
  bool identifiable = true;
  double lower;
  double upper;
};

struct SolverOutcome {
  RunResult run;
  std::optional<double> nrmse_heldout;
};

struct Identification {
  // Recordings the solvers were compared on: all of `count` but those held out.
  [[nodiscard]] std::vector<std::size_t> compared_on(std::size_t count) const;

  Layout layout;
  std::vector<Term> terms;
  std::vector<Estimate> estimates;
  std::vector<SolverOutcome> solvers;  // in the order asked
  std::size_t chosen = 0;
  double cost = 0.0;  // overall NRMSE over the fitted recordings
  std::optional<double> nrmse_heldout;
  std::vector<std::size_t> fitted;
  std::vector<std::size_t> heldout;
  bool roles_given = false;  // else held-out recordings were chosen here, and the final fit uses all
  // What followed the solvers compared, from the best point of the chosen one: a fit on all recordings where some were
  // held out by the program, else a descent where the chosen solver does not descend by itself. Its evaluations are
  // its own, outside the budget of the solvers compared.
  std::optional<RunResult> final_run = {};
  std::string final_stage = {};
  std::vector<std::string> warnings = {};
  Message bounds_met = "";  // bounds_text of the final point
  // At the final point; absent and empty where an interruption came before them.
  std::optional<Correlations> correlations = {};
  std::vector<ScaledSensitivity> sensitivities = {};
};

std::vector<Recording> pick(const std::vector<Recording>& recordings, const std::vector<std::size_t>& indices);

// Overall NRMSE of a set of terms on recordings it need not have seen; `normalised_by` as in overall (fit/score.hpp).
double predicted_nrmse(const Layout& layout, const std::vector<Term>& terms,
                       const std::vector<const Recording*>& recordings, const ObjectiveOptions& options,
                       const std::vector<const Recording*>& normalised_by = {});

// The problem a solver is given: options.budget, options.settings as far as the solver knows them, and a stream of the
// seed, the stage's name and the solver.
Problem make_problem(const Objective& objective, const SolverEntry& entry, const IdentifyOptions& options,
                     const std::string& stage, std::vector<double> start);

// Which recordings to hold out when no roles are given: about a fifth, spread over drive level and severity.
std::vector<std::size_t> choose_heldout(const std::vector<Recording>& recordings);

using Progress = std::function<bool(const std::string& stage, const RunResult& run)>;

// Throws InputError for options that do not fit the data, WorkError when no candidate simulates.
Identification identify(const Campaign& campaign, const std::string& model, const IdentifyOptions& options,
                        const Progress& progress);

// Correlation of residuals with their neighbours in time: N samples are worth N (1 - r) / (1 + r).
double residual_correlation(const Objective& objective, const std::vector<Term>& terms);

// Estimates of every searched term at a point: value, standard error, bounds met, identifiability. Sets
// result.estimates, bounds_met, correlations and sensitivities; result.layout and result.terms must be those of the
// point.
void estimate(Identification& result, const Objective& objective, const std::vector<double>& point,
              DriveKind drive_kind);
// The same of another objective: from its cost and derivatives at the point, and how many independent samples it sums
// over; from the curvature alone, without a jackknife, and without sensitivities.
void estimate(Identification& result, const Response& derivatives, double independent, const std::vector<double>& point,
              DriveKind drive_kind);

// Estimate::ci95 of a term of a parameter with this card whose interval has this half width to first order.
std::optional<Interval> interval_of(const Term& term, const Parameter& card, double half_width);

// What a reader has to be warned of in estimates: not identifiable. On a bound: Identification::bounds_met.
std::vector<std::string> warnings_of(const std::vector<Estimate>& estimates);

}  // namespace hysteron
