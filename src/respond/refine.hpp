// Identification from the motion of a mass on a damper under a known force, in free decay, or on a base that moves by
// b:
//   m x'' + C x' + K x + F(x, x', ...; p) = f(t),  or  -m b''(t)  with x relative to the base
// First from the equation of motion, which gives the damper's force at every sample where m, C, K and the acceleration
// are known, and any identification of the damper alone then is one of the response (damper_recordings). The
// acceleration multiplies the noise of the displacement; so then the descent from there, in which the motion is
// simulated and compared with the recorded one (refine).
#pragma once

#include <string>
#include <vector>

#include "fit/identify.hpp"
#include "respond/signal.hpp"

namespace hysteron {

// What is known of the test beside the damper.
struct Rig {
  double mass = 1.0;                                   // kg
  double stiffness = 0.0;                              // N/m, of a spring beside the damper
  double damping = 0.0;                                // N s/m, of a dashpot beside it
  Interpolation interpolation = Interpolation::cubic;  // of force or base between the samples
  bool base = false;                                   // the base moves, and no force acts on the mass
};

// What excites the mass, N: the recorded force, -m b'' of a base, or nothing.
std::vector<double> excitation_of(const Recording& response, const Rig& rig);
// Recordings of the damper alone, of those of the response: force f - m x'' - C x' - K x, f being what excites the
// mass, x'' recorded or the slope of the velocity.
std::vector<Recording> damper_recordings(const std::vector<Recording>& responses, const Rig& rig);

struct ResponseScore {
  std::string file;
  double nrmse;  // RMSE over the largest |x|
  double rmse;   // m
};

// Throws InputError for a model that cannot respond to one of the recordings: known before anything is fitted.
void refuse_if_not_responding(const Layout& layout, const std::vector<Recording>& responses, const Rig& rig);

// Motion of the mass of a recording.
struct SimulatedMotion {
  std::vector<double> displacement;  // m; empty where it runs away
};

struct ResponseFit {
  double before = 0.0;  // NRMSE of the displacement with the parameters of the equation of motion; diverged_cost or
                        // more where that motion runs away
  double cost = 0.0;    // afterwards, root mean square over the fitted recordings
  std::vector<ResponseScore> scores;     // of every recording; NaN where the motion runs away
  std::vector<SimulatedMotion> motions;  // likewise
  RunResult run;
};

// Descends from result.terms over result.fitted, with displacement and velocity at the start of each recording as
// further unknowns: the noise of the first samples is not the motion's. Sets terms and estimates. Recordings that are
// not fitted start with what their first samples say. Throws WorkError where no motion near result.terms stays finite,
// InputError for a model that cannot respond.
ResponseFit refine(Identification& result, const std::vector<Recording>& responses, const Rig& rig,
                   const IdentifyOptions& options, const Observer& observer);

}  // namespace hysteron
