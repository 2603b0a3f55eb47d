// One step of the search: every extension of what stands, looked at first (score.hpp), the promising ones refitted with
// all other parameters.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/residual/block_score.hpp"
#include "diagnose/search/score.hpp"

namespace hysteron {

// Rounds of a first refit, and of a fit that is compared with others.
constexpr int screening_rounds = 5;
constexpr int fitting_rounds = 10;

// An extension is worth a place when the criterion gains this much (on top of what choosing among many costs), and the
// squared error falls by this share.
constexpr double least_evidence_of_a_place = 6.0;
constexpr double least_gain_of_a_place = 0.01;

// An extension tried at one stage, against what stood before it. Squares are of NRMSE.
struct Tried {
  Extension part;
  double gain = 0.0;       // squares before - squares after; to first order where it was not refitted
  double evidence = 0.0;   // gain of the Bayesian information criterion with the independent samples; > 0 is for it
  std::optional<Fit> fit;  // where it was refitted
};

// Parameters whose law in the drive could have one more order: as many as there are drive levels allow.
std::vector<Extension> law_candidates(const Workbench& bench, const Hypothesis& what);
// All parameters that follow the drive with one order more, and with two, where there are levels for it: the drive acts
// on them through the same curve.
std::vector<Extension> joint_law_candidates(const Workbench& bench, const Hypothesis& what);

// What `fit` gains on squares of NRMSE left before, by a fit of so many dimensions; `independent` samples as in
// evidence().
Tried weighed(const Extension& part, const Fit& fit, double squares_before, std::size_t dimension_before,
              double independent);

// The first `most` of `tried` that were refitted, fitted on with the rounds of a fit that is compared with others.
void polish(const Workbench& bench, std::vector<Tried>& tried, std::size_t most, std::size_t dimension_before,
            double independent);

// All candidates behind `before`, the promising ones refitted: best first, those refitted before the others. Members of
// `always` are refitted whatever their score, but behind a series element, where the four best scores take all places:
// refits cost most there. The base's parameters start from those of `before` and, where given, of `also`. `done` is
// told the share of it that is done, from one thread at a time.
std::vector<Tried> stage(const Workbench& bench, const Fit& before, const std::vector<Extension>& candidates,
                         double independent, const Fit* also = nullptr, const std::vector<Extension>& always = {},
                         const std::function<void(double share)>& done = {});

// Order of what was tried: refitted before not refitted, then by evidence.
bool better(const Tried& a, const Tried& b);

// Whether it is worth a place, being the best of so many candidates: by the criterion, or, where a residual so slow
// that it holds few independent samples leaves that undecided, by how surely it predicts recordings left out.
// Far from the noise, where every residual is slow, a plain gain that recordings left out share is enough: such a part
// is there to predict.
bool worth(const Tried& tried, const Fit& before, double candidates, const BlockScore& left_out, bool far);
// Whether a part of the model stays: likewise, without the price of choosing.
bool worth_keeping(double evidence, double gain, double squares_without, const BlockScore& left_out, bool far);

}  // namespace hysteron
