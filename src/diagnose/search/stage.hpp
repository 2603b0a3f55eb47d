// One step of the search: every hypothesis that has one part more than what stands, each with its best parameters.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Rounds of a first look, and of a fit that is compared with others.
constexpr int screening_rounds = 5;
constexpr int fitting_rounds = 10;

// An effect is worth a place when the criterion gains this much (on top of what choosing among many costs), and the
// squared error falls by this share.
constexpr double least_evidence_of_a_place = 6.0;
constexpr double least_gain_of_a_place = 0.01;

// A hypothesis tried at one stage, against what stood before it.
struct Tried {
  std::string id;  // effect, or "law:PARAMETER,..." for richer parameter laws
  Fit fit;
  double evidence = 0.0;      // gain of the Bayesian information criterion with the effective samples, > 0 is for it
  double gain = 0.0;          // squares before - squares after
  double heldout_gain = 0.0;  // likewise on the judged recordings
};

// Whether an id of Tried, Rival or Found is of richer parameter laws: "law:PARAMETER,...", one order more for each time
// a parameter is listed.
bool is_law(const std::string& id);
// The id of one order more for one parameter, and the first parameter of an id of laws.
std::string law_of_parameter(const std::string& parameter);
std::string parameter_of_law(const std::string& id);

Hypothesis with(const Hypothesis& what, const std::string& id);
Hypothesis without(const Hypothesis& what, const std::string& id);
bool contains(const Hypothesis& what, const std::string& id);

// Parameters whose law in the drive could have one more order, as ids: as many as there are drive levels allow.
std::vector<std::string> law_candidates(const Workbench& bench, const Hypothesis& what);
// All parameters that follow the drive with one order more, and with two, where there are levels for it: the drive acts
// on them through the same curve.
std::vector<std::string> joint_law_candidates(const Workbench& bench, const Hypothesis& what);

// What `fit` gains on `before`; `effective` as in evidence().
Tried weighed(const std::string& id, const Fit& fit, const Fit& before, double effective);

// All candidates behind `before`, a few rounds each, the best taken further; best first. The base's parameters start
// from those of `before` and, where given, of `also`.
std::vector<Tried> stage(const Workbench& bench, const Fit& before, const std::vector<std::string>& candidates,
                         double effective, const Fit* also = nullptr);

// The best effects among what was tried, best first: those worth trying again behind more.
std::vector<std::string> promising(const std::vector<Tried>& tried);

// Whether it is worth a place, being the best of so many candidates. Judging recordings that do not excite the effect
// may get a little worse.
bool worth(const Tried& tried, const Fit& before, double candidates);

}  // namespace hysteron
