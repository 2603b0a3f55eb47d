// A recording as the objective sees it: its motion prepared for marching, and where its march and its cost begin.
#pragma once

#include <functional>
#include <vector>

#include "core/recording.hpp"
#include "fit/score.hpp"
#include "simulate/motion.hpp"

namespace hysteron {

struct ObjectiveOptions {
  Normalisation normalisation = Normalisation::max_abs;
  Weighting weighting = Weighting::per_recording;
  double tolerance = 1e-4;  // relative error of the integration
  bool comparing = false;   // coarser than any tolerance: comparing_motion
  // Series elements bear the measured force, so that no balance is solved (simulate/under_load.hpp). For starts of a
  // descent, not for forces.
  bool under_measured_force = false;
  int threads = 0;  // 0: OpenMP's default
  // Leave out of the cost the run-in of recordings that begin in mid-motion and never come back to their start, so that
  // the initial hysteresis is neither known nor found by marching a period beforehand.
  bool skip_run_in = false;
  // Samples of all recordings up to which the intervals between them are kept with the motion. Of more they are
  // prepared anew in every march (lean motions), which costs less than the memory.
  std::size_t most_prepared_samples = 500'000;
  // Asked often, also within an evaluation, which a stiff candidate can make long; once true evaluations throw Stopped.
  std::function<bool()> stopped = {};
};

struct Target {
  Motion motion;
  std::vector<double> force;
  double normaliser = 1.0;
  double weight = 1.0;     // of a squared residual in cost^2
  double frequency = 0.0;  // Hz
  double drive = 0.0;      // mean level; used when the drive is constant
  // Those of the recording, in its order: one value a sample, or one where it does not vary.
  std::vector<std::vector<double>> conditions;
  std::vector<EarlierWork> earlier;  // of the recording
  bool inputs_vary = false;          // the drive, or a condition: parameters may differ from sample to sample
  std::size_t run_in = 0;            // samples at the start that do not count
  std::size_t preroll = 0;  // samples of the first period marched beforehand when the recording starts in motion
  Motion lead_in;           // them, with the sample after them; empty without
  double fastest = 0.0;     // m/s, bound of |v|

  // Values of the conditions at a sample.
  [[nodiscard]] std::vector<double> conditions_at(std::size_t n) const;
};

// The first `count` samples of a motion as one of their own.
Motion beginning_of(const Motion& motion, std::size_t count);

Target make_target(const Recording& recording, const ObjectiveOptions& options, bool lean);
// Lean where the recording is long.
Target make_target(const Recording& recording, const ObjectiveOptions& options);
// The same recording thinned and marched coarsely, for a first look at candidates.
Target make_screening_target(const Target& full, const Recording& recording, const ObjectiveOptions& options);

}  // namespace hysteron
