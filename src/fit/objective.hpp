// The one objective of all identification: NRMSE of the simulated force over the recordings.
//   cost = sqrt( mean over recordings of NRMSE_r^2 ),  NRMSE_r = RMSE_r / normaliser_r
// (or pooled over samples). Batches are the only evaluation path: packs of eight candidates, threads over packs and
// recordings, sums in time order per candidate, so that results do not depend on threads or company.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fit/layout.hpp"
#include "fit/solver.hpp"

namespace hysteron {

enum class Normalisation { max_abs, range, standard_deviation, mean_abs };
enum class Weighting { per_recording, pooled };

// Throws InputError for an unknown word.
Normalisation normalisation_of(const std::string& word);
std::string_view word_of(Normalisation normalisation);
// What a force signal is divided by; throws InputError naming the file when it is zero.
double normaliser(const Recording& recording, Normalisation normalisation);

struct ObjectiveOptions {
  Normalisation normalisation = Normalisation::max_abs;
  Weighting weighting = Weighting::per_recording;
  double tolerance = 1e-4;  // relative error of the integration
  bool comparing = false;   // coarser than any tolerance: comparing_motion
  int threads = 0;          // 0: OpenMP's default
  // Leave out of the cost the run-in of recordings that begin in mid-motion and never come back to their start, so that
  // the initial hysteresis is neither known nor found by marching a period beforehand.
  bool skip_run_in = false;
  // Asked often, also within an evaluation, which a stiff candidate can make long; once true evaluations throw Stopped.
  std::function<bool()> stopped = {};
};

// A recording as the objective sees it.
struct Target {
  Motion motion;
  std::vector<double> force;
  double normaliser = 1.0;
  double weight = 1.0;     // of a squared residual in cost^2
  double frequency = 0.0;  // Hz
  double drive = 0.0;      // mean level; used when the drive is constant
  bool drive_varies = false;
  std::size_t run_in = 0;   // samples at the start that do not count
  std::size_t preroll = 0;  // samples of the first period marched beforehand when the recording starts in motion
  Motion lead_in;           // them, with the sample after them; empty without
};

Target make_target(const Recording& recording, const ObjectiveOptions& options);

// Of one candidate on a recording: weighted residuals, whose squares summed over all recordings are cost^2, and their
// derivatives with respect to the unit coordinates, samples x dimension (row-major). Zero in the run-in.
struct Linearised {
  std::vector<double> residual;
  std::vector<double> jacobian;
};

class Objective {
 public:
  Objective(const Layout& layout, const std::vector<Recording>& recordings, const ObjectiveOptions& options);

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const std::vector<Target>& targets() const { return targets_; }
  // The same recordings thinned and marched coarsely, for requests that only screen.
  [[nodiscard]] const std::vector<Target>& screening_targets() const { return screening_targets_; }
  [[nodiscard]] std::size_t samples() const;
  // Tells a problem what its windows may be: samples of the recordings, state variables.
  void describe_data(Problem& problem) const;
  // Costs (and derivatives with respect to unit coordinates) of the request's points, or residuals of its window.
  // Throws Stopped, as linearised does.
  [[nodiscard]] Response evaluate(const Request& request) const;
  // One entry per recording.
  [[nodiscard]] std::vector<Linearised> linearised(const std::vector<double>& point) const;

 private:
  // Over a target, for every candidate of a pack.
  struct PackSums {
    Lanes squares;  // of the residual
    Lanes alive;    // samples that stayed finite
  };
  // Takes samples [begin, begin + count): jacobian count x dimension, residual count, unweighted.
  using TakeDerivatives =
      std::function<void(std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual)>;

  // Hands every sample to `take`, in order.
  [[nodiscard]] PackSums differentiated(const std::vector<double>& points, std::span<const std::size_t> rows,
                                        const Target& target, const TakeDerivatives& take) const;
  template <class T>
  void run_pack(const std::vector<double>& points, std::span<const std::size_t> rows, const Target& target,
                double* sums) const;
  [[nodiscard]] Response evaluate_window(const Request& request) const;
  [[nodiscard]] std::vector<std::size_t> packing(const std::vector<double>& points) const;
  void check_stopped() const;

  Layout layout_;
  std::vector<Target> targets_;
  std::vector<Target> screening_targets_;
  int threads_;
  std::function<bool()> stopped_;
};

// Predicted force of one parameter set on a recording's motion.
std::vector<double> predict(const CompositeModel& model, const std::vector<double>& held,
                            const std::vector<Term>& terms, const Target& target);

struct Score {
  double nrmse;
  double rmse;         // N
  double fit_percent;  // 100 (1 - RMSE / standard deviation)
};
Score score(const std::vector<double>& predicted, const Recording& recording, Normalisation normalisation);
// Over recordings: root mean square of NRMSE, or pooled over samples.
double overall(const std::vector<Score>& scores, const std::vector<Recording>& recordings, Normalisation normalisation,
               Weighting weighting);

}  // namespace hysteron
