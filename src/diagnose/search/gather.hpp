// The evidence of a search: every fit it ended with is simulated and differentiated once on the same recordings, and
// all that a verdict asks is taken from there.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "diagnose/judge/evidence.hpp"
#include "diagnose/residual/contrast.hpp"
#include "diagnose/search/observe.hpp"
#include "diagnose/search/search.hpp"
#include "io/channel_lag.hpp"
#include "simulate/knowledge.hpp"

namespace hysteron {

struct ParameterInterval {
  std::string name;
  std::string unit;
  double value = 0.0;
  std::optional<double> half_width;  // of the 95 % interval to first order; absent on a bound and where unknown
  std::optional<Interval> ci95;      // wider by what unmodelled physics may do (intervals.hpp); absent where unknown
  std::optional<BoxEnd> bound = {};  // end of its box that the value sits on
  double lower = -1e300;             // of its box
};

// What is known beside the errors of the fits.
struct Circumstances {
  // Of an effect's parameters in a fit, in the order of its card.
  std::function<std::vector<ParameterInterval>(const Fit& fit, const std::string& effect)> intervals;
  // What displacement and velocity tell of a lag between them, without a model.
  std::optional<ChannelLag> channel;
  // Signature contrasts of what the base model leaves of the fitted recordings.
  std::vector<Contrast> contrasts;
  // Those of what any fit leaves of them, without placebos.
  std::function<std::vector<Contrast>(const Fit& fit)> contrasts_of;
  // Told the share of the fits that was looked at, from one thread at a time; may be empty.
  std::function<void(double share)> looked = {};
};

// Of the candidates, those that the channels of the recordings show by themselves: a contrast that needs no model
// speaks for them.
std::vector<std::string> told_by_channels(const std::vector<Recording>& recordings,
                                          const std::vector<std::string>& candidates);

// On `fine`, of the fitted recordings. The doubts are left empty.
Evidence evidence_of(const Search& search, const Workbench& fine, const Circumstances& known);

}  // namespace hysteron
