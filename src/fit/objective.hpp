// The one objective of all identification: NRMSE of the simulated force over the recordings.
//   cost = sqrt( mean over recordings of NRMSE_r^2 ),  NRMSE_r = RMSE_r / normaliser_r
// (or pooled over samples). Batches are the only evaluation path: packs of eight candidates, or two of them side by
// side, threads over packs and recordings, sums in time order per candidate, so that results do not depend on threads
// or company.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fit/directions.hpp"
#include "fit/layout.hpp"
#include "fit/predict.hpp"
#include "fit/solver.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Of one candidate on a recording: weighted residuals, whose squares summed over all recordings are cost^2, and their
// derivatives with respect to the unit coordinates, samples x dimension (row-major). Zero in the run-in.
struct Linearised {
  std::vector<double> residual;
  std::vector<double> jacobian;
};

class Objective {
 public:
  // Keeps nothing of the recordings themselves.
  Objective(const Layout& layout, const std::vector<Recording>& recordings, const ObjectiveOptions& options);
  Objective(const Layout& layout, const std::vector<const Recording*>& recordings, const ObjectiveOptions& options);

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
  // The same, handed over in pieces: samples [begin, begin + count) of a recording, in order. Recordings come side by
  // side, from several threads.
  using TakeLinearised = std::function<void(std::size_t recording, std::size_t begin, std::size_t count,
                                            const double* residual, const double* jacobian)>;
  void linearise(const std::vector<double>& point, const TakeLinearised& take) const;

 private:
  // Over a target, for every candidate of a pack.
  struct PackSums {
    Lanes squares;  // of the residual
    Lanes alive;    // samples that stayed finite
  };
  // Takes samples [begin, begin + count): jacobian count x directions, residual count, unweighted.
  using TakeDerivatives =
      std::function<void(std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual)>;

  // Hands every sample to `take`, in order.
  [[nodiscard]] PackSums differentiated(const std::vector<double>& points, std::span<const std::size_t> rows,
                                        const Target& target, const Directions& directions,
                                        const TakeDerivatives& take) const;
  // Write what evaluate sums up of a pack on a target: weighted sum of squares and samples alive, and with derivatives
  // the gradient and the upper triangle of the Gauss-Newton matrix, each for all lanes.
  // A wide pack writes for two packs, the second one's sums `next_pack` after the first one's.
  template <class P>
  void sum_costs(const std::vector<double>& points, std::span<const std::size_t> rows, const Target& target,
                 double* sums, std::size_t next_pack) const;
  void sum_derivatives(const std::vector<double>& points, std::span<const std::size_t> rows, const Target& target,
                       double* sums) const;
  [[nodiscard]] Response evaluate_window(const Request& request) const;
  void check_stopped() const;

  Layout layout_;
  std::vector<Target> targets_;
  std::vector<Target> screening_targets_;
  int threads_;
  std::function<bool()> stopped_;
};

}  // namespace hysteron
