// Parameter laws in two stages, as the literature finds them: every condition fitted freely, then polynomials through
// the values, parameters frozen to them one by one. Beside it stands the fit of all coefficients at once
// (identify.hpp).
//
// Stage one: all parameters are free in each condition, a condition being the recordings of one drive level and
// frequency. Stage two repeats, until nothing is free: of the parameters still free - those without a law first - take
// the one whose values scatter least about its law, as a share of its box (of its logarithm where the search is
// logarithmic); give it the law; fit the others again in every condition, from where they were. A law's node values
// minimise
//   sum over conditions of ((value - law(drive, frequency)) / sigma)^2
// and are kept in the box. sigma is the standard error, at least 1 % of the value; the width of the box where the data
// of the condition do not determine the value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/identify.hpp"

namespace hysteron {

// A parameter's value as one condition has it.
struct ConditionValue {
  double value;
  std::optional<double> std_error;
};

struct Condition {
  double drive;                         // A or V
  double frequency;                     // Hz
  std::vector<std::size_t> recordings;  // of the campaign
  double nrmse = 0.0;                   // all parameters free
  std::vector<ConditionValue> values;   // one per law of the layout, all parameters free
};

struct FrozenParameter {
  std::size_t law;  // of the layout
  double scatter;   // about the law, share of the box
  double nrmse;     // over all conditions, what is left free fitted again
};

struct TwoStage {
  std::vector<Condition> conditions;
  std::vector<FrozenParameter> steps;  // in the order frozen
  std::vector<double> point;           // node values in the unit box of the layout
  double nrmse_free = 0.0;             // stage one, over all conditions
  double nrmse = 0.0;                  // of the laws, on the fitted recordings
  std::optional<double> nrmse_heldout;
  std::size_t evaluations = 0;  // in evaluations of all fitted recordings, rounded up
};

// Node values of a law through values at (drive, frequency), in the law's box.
std::vector<double> law_through(const ParameterLaw& law, const Parameter& card,
                                const std::vector<Condition>& conditions, const std::vector<ConditionValue>& values);

// `layout` holds the laws and the box, `solver` searches stage one, within half of options.budget; the rest is for the
// repeated fits of stage two. Throws InputError when there are fewer conditions than coefficients of a law, WorkError
// when a condition finds no candidate that simulates.
TwoStage fit_two_stage(const Campaign& campaign, const Layout& layout, const std::vector<std::size_t>& fitted,
                       const std::vector<std::size_t>& heldout, const SolverEntry& solver,
                       const IdentifyOptions& options, const Progress& progress);

}  // namespace hysteron
