// Unscented Kalman filter: parameters and state variables as one Gaussian, followed through the recordings in time
// order. Of a window of `block` samples with residuals r = F_model - F_measured (weighted so that cost^2 = sum r^2):
//   X_j+- = x +- h c_j           sigma points; c_j: columns of the Cholesky factor of the covariance P, j = 1..L
//   (X, r) -> (X', r')           each marched through the window with its own parameters and states
//   x' = X'_0 + sum_j (X'_j+ + X'_j- - 2 X'_0) / (2 h^2),  r' likewise
//   D = [X'_j+- - X'_0] / (sqrt(2) h),  E = [r'_j+- - r'_0] / (sqrt(2) h)
//   P' = D D^T,  S = E E^T + R I,  K = D E^T S^-1;   x <- x' - K r',  P <- P' - K S K^T + Q
// Deviations are taken about the centre's image, so that P' has no negative weight (Julier, Uhlmann and Durrant-Whyte
// 2000, doi 10.1109/9.847726, section on negative kappa). The update is computed as K = D M^-1 E^T / R, P = D M^-1 D^T
// with M = I + E^T E / R, which is the same by the matrix inversion lemma and keeps P positive.
// h = sqrt(L + kappa) is `reach`, for every direction of its own no more than lets both points stay in the box (second
// differences are divided by at least 1); the parameters' mean keeps 1e-3 from the box.
// Parameters do not move of themselves: Q = walk^2 (samples of the window / all samples) for them, 0 for the states.
// At the start of a recording the states are those of the simulation's start, a function of the parameters.
//
// R, the variance of one residual, is noise^2 / N where `noise` is set. Otherwise it is found by passing through the
// data again: R = cost^2 / N (1 + c) / (1 - c), with the cost at the point the pass starts from and c the lag-1
// correlation of the innovations of the pass before, so that correlated residuals count as fewer samples. Every pass
// starts from the best end so far with the first covariance, spread^2 I; a pass that ends worse halves the spread of
// the next. Source: Julier and Uhlmann 2004, doi 10.1109/JPROC.2003.823141; Wan and van der Merwe 2000,
// doi 10.1109/ASSPCC.2000.882463. For Bouc-Wen systems: Wu and Smyth 2007, doi 10.1002/stc.186.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_ukf;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Setting settings[] = {
    {"spread", 0.1, 1e-6, 1.0, "standard deviation of every parameter at the start of a pass, share of its box"},
    {"reach", 1.7320508075688772, 0.1, 10.0, "distance of the sigma points in standard deviations"},
    {"walk", 0.0, 0.0, 10.0, "standard deviation by which a parameter wanders over all data, share of its box"},
    {"noise", 0.0, 0.0, 10.0, "noise of the force as NRMSE; 0: found by repeated passes"},
    {"block", 8.0, 1.0, 1e6, "samples of an update"},
    {"passes", 60.0, 1.0, 1e6, "passes through the data, at most"},
};

// Distance the mean keeps from the box.
constexpr double margin = 1e-3;

// Lower Cholesky factor of a positive semidefinite matrix: a pivot that has vanished leaves its column zero.
MatrixXd factor_of(const MatrixXd& matrix) {
  const Index size = matrix.rows();
  MatrixXd factor = MatrixXd::Zero(size, size);
  for (Index j = 0; j < size; ++j) {
    const double pivot = matrix(j, j) - factor.row(j).head(j).squaredNorm();
    if (!(pivot > 1e-14 * matrix(j, j))) {
      continue;
    }
    factor(j, j) = std::sqrt(pivot);
    for (Index i = j + 1; i < size; ++i) {
      factor(i, j) = (matrix(i, j) - factor.row(i).head(j).dot(factor.row(j).head(j))) / factor(j, j);
    }
  }
  return factor;
}

class UnscentedKalmanFilter final : public Solver {
 public:
  explicit UnscentedKalmanFilter(const Problem& problem)
      : problem_(problem), parameters_(static_cast<Index>(problem.dimension)) {
    support::check_problem(problem, solver_ukf);
    samples_ = std::accumulate(problem.recordings.begin(), problem.recordings.end(), std::size_t{0});
    spread_ = setting(problem, solver_ukf, "spread");
    reach_ = setting(problem, solver_ukf, "reach");
    walk_ = setting(problem, solver_ukf, "walk");
    noise_ = setting(problem, solver_ukf, "noise");
    block_ = support::whole_setting(problem, solver_ukf, "block");
    passes_ = support::whole_setting(problem, solver_ukf, "passes");
    mean_ = problem.start.empty()
                ? VectorXd::Constant(parameters_, 0.5)
                : VectorXd(Eigen::Map<const VectorXd>(problem.start.data(), parameters_).cwiseMax(0.0).cwiseMin(1.0));
  }

  Request ask() override {
    Request request;
    if (!reason_.empty()) {
      return request;
    }
    if (!window_) {
      request.points.assign(mean_.data(), mean_.data() + parameters_);
      return request;
    }
    request.window = *window_;
    for (Index k = 0; k < sigma_.cols(); ++k) {
      const double* column = sigma_.col(k).data();
      request.points.insert(request.points.end(), column, column + parameters_);
      request.states.insert(request.states.end(), column + parameters_, column + sigma_.rows());
    }
    return request;
  }

  void tell(const Request& /*request*/, const Response& response) override {
    if (!reason_.empty()) {
      return;
    }
    if (!window_) {
      if (!response.cost.empty()) {
        spent_ += std::max<std::size_t>(samples_, 1);
        end_pass(response.cost[0]);
      }
      return;
    }
    if (static_cast<Index>(response.cost.size()) < sigma_.cols()) {
      reason_ = "budget: sigma points answered " + std::to_string(response.cost.size()) + " < " +
                std::to_string(sigma_.cols());
      return;
    }
    spent_ += response.cost.size() * window_samples();
    if (response.cost[0] >= diverged_cost) {
      // No prediction to update: the pass ends where it is.
      window_.reset();
      return;
    }
    update(response);
    advance();
  }

  [[nodiscard]] std::string stopped_because() const override { return reason_; }
  [[nodiscard]] std::vector<Tracked> track() const override { return track_; }

 private:
  // In the driver's unit: samples, or evaluations where there are no recordings.
  [[nodiscard]] std::size_t window_samples() const {
    return samples_ == 0 ? std::size_t{1} : window_->end - window_->begin;
  }

  // The mean has been evaluated on all data: a pass begins, or the filter stops.
  void end_pass(double cost) {
    if (cost >= diverged_cost && best_.size() == 0) {
      // Nothing to filter from: elsewhere in the box.
      for (Index k = 0; k < parameters_; ++k) {
        mean_[k] = problem_.stream.uniform(draws_, static_cast<std::uint32_t>(k));
      }
      ++draws_;
      return;
    }
    const bool first = best_.size() == 0;
    const bool improved = first || cost < best_cost_ * (1.0 - tolerance);
    if (!first) {
      ++done_;
      quiet_ = improved ? 0 : quiet_ + 1;
      if (track_.empty() || cost <= best_cost_ * (1.0 + 10.0 * tolerance)) {
        track_ = passing_;
      }
      if (!(cost <= best_cost_ * (1.0 + tolerance))) {
        spread_ *= 0.5;
      }
    }
    if (first || cost < best_cost_) {
      best_ = mean_;
      best_cost_ = cost;
    }
    if (last_) {
      reason_ = "budget: the last pass through the data is not whole";
    } else if (done_ >= passes_) {
      reason_ = "passes: " + std::to_string(done_) + " = " + std::to_string(passes_);
    } else if (quiet_ >= 3) {
      reason_ = "cost fell by less than " + support::number_text(tolerance) + " of itself in 3 passes";
    } else if (best_cost_ <= 0.0) {
      reason_ = "cost = 0";
    } else {
      begin_pass();
    }
  }

  void begin_pass() {
    mean_ = best_.cwiseMax(margin).cwiseMin(1.0 - margin);
    covariance_ = MatrixXd::Identity(parameters_, parameters_) * spread_ * spread_;
    passing_.clear();
    correlation_ = done_ > 0 ? std::clamp(lag_product_ / std::max(innovation_squares_, 1e-300), 0.0, 0.9999) : 0.0;
    innovation_squares_ = 0.0;
    lag_product_ = 0.0;
    open(0, 0);
  }

  // Next window, or none where the data end or where what is left of the budget is needed to evaluate the result.
  void open(std::size_t recording, std::size_t begin) {
    if (begin == 0) {
      // The states start as functions of the parameters.
      mean_.conservativeResize(parameters_);
      covariance_.conservativeResize(parameters_, parameters_);
    }
    Window next{recording, begin, begin};
    if (samples_ > 0) {
      next.end = std::min(begin + block_, problem_.recordings[recording]);
    }
    window_ = next;
    place_sigma_points();
    const std::size_t unit = std::max<std::size_t>(samples_, 1);
    const std::size_t price = static_cast<std::size_t>(sigma_.cols()) * window_samples();
    if (spent_ + price + unit > problem_.budget * unit) {
      finish();
      if (passing_.empty()) {
        reason_ = "budget: none left for sigma points";
      }
      last_ = true;
    }
  }

  void advance() {
    std::size_t recording = window_->recording;
    std::size_t begin = window_->end;
    if (samples_ == 0) {
      finish();
      return;
    }
    while (recording < problem_.recordings.size() && begin >= problem_.recordings[recording]) {
      ++recording;
      begin = 0;
    }
    if (recording == problem_.recordings.size()) {
      finish();
    } else {
      open(recording, begin);
    }
  }

  void finish() {
    window_.reset();
    mean_.conservativeResize(parameters_);
  }

  void place_sigma_points() {
    const Index size = mean_.size();
    const MatrixXd factor = factor_of(covariance_);
    const auto states = static_cast<Index>(problem_.states);
    sigma_ = MatrixXd::Zero(parameters_ + states, 2 * size + 1);
    sigma_.topRows(size).colwise() = mean_;
    step_ = VectorXd::Constant(size, reach_);
    for (Index j = 0; j < size; ++j) {
      for (Index i = 0; i < parameters_; ++i) {
        const double length = std::fabs(factor(i, j));
        const double room = std::min(mean_[i], 1.0 - mean_[i]);
        if (length * step_[j] > room) {
          step_[j] = room / length;
        }
      }
      sigma_.col(1 + 2 * j).head(size) += step_[j] * factor.col(j);
      sigma_.col(2 + 2 * j).head(size) -= step_[j] * factor.col(j);
    }
    sigma_.topRows(parameters_) = sigma_.topRows(parameters_).cwiseMax(0.0).cwiseMin(1.0);
  }

  void update(const Response& response) {
    const Index count = sigma_.cols();
    const auto states = static_cast<Index>(problem_.states);
    const auto rows = static_cast<Index>(response.residual.size()) / count;
    const Eigen::Map<const MatrixXd> residual(response.residual.data(), rows, count);
    if (states > 0 && static_cast<Index>(response.states.size()) == states * count) {
      sigma_.bottomRows(states) = Eigen::Map<const MatrixXd>(response.states.data(), states, count);
    }
    VectorXd mean = sigma_.col(0);
    VectorXd innovation = residual.col(0);
    MatrixXd d = MatrixXd::Zero(sigma_.rows(), count - 1);
    MatrixXd e = MatrixXd::Zero(rows, count - 1);
    for (Index j = 0; 2 * j + 2 < count; ++j) {
      const Index plus = 1 + 2 * j;
      const Index minus = 2 + 2 * j;
      const double scale = 1.0 / (std::sqrt(2.0) * step_[j]);
      d.col(plus - 1).head(parameters_) = scale * (sigma_.col(plus) - sigma_.col(0)).head(parameters_);
      d.col(minus - 1).head(parameters_) = scale * (sigma_.col(minus) - sigma_.col(0)).head(parameters_);
      if (response.cost[static_cast<std::size_t>(plus)] >= diverged_cost ||
          response.cost[static_cast<std::size_t>(minus)] >= diverged_cost) {
        continue;  // the direction keeps its variance and teaches nothing
      }
      d.col(plus - 1).tail(states) = scale * (sigma_.col(plus) - sigma_.col(0)).tail(states);
      d.col(minus - 1).tail(states) = scale * (sigma_.col(minus) - sigma_.col(0)).tail(states);
      e.col(plus - 1) = scale * (residual.col(plus) - residual.col(0));
      e.col(minus - 1) = scale * (residual.col(minus) - residual.col(0));
      const double bend = 0.5 / std::pow(std::max(step_[j], 1.0), 2);
      mean.tail(states) += bend * (sigma_.col(plus) + sigma_.col(minus) - 2.0 * sigma_.col(0)).tail(states);
      innovation += bend * (residual.col(plus) + residual.col(minus) - 2.0 * residual.col(0));
    }
    note(innovation);
    const std::size_t all = samples_ > 0 ? samples_ : static_cast<std::size_t>(std::max<Index>(rows, 1));
    const double level = noise_ > 0.0 ? noise_ : best_cost_;
    const double coloured = noise_ > 0.0 ? 1.0 : (1.0 + correlation_) / (1.0 - correlation_);
    // Below the floor nothing but rounding is left.
    const double variance =
        std::max({level * level / static_cast<double>(all) * coloured, 1e-12 * e.squaredNorm(), 1e-300});
    MatrixXd m = e.transpose() * e / variance;
    m.diagonal().array() += 1.0;
    const Eigen::LLT<MatrixXd> solver(m);
    mean -= d * solver.solve(e.transpose() * innovation) / variance;
    mean_ = mean;
    const MatrixXd half = solver.matrixL().solve(d.transpose());
    covariance_ = half.transpose() * half;
    mean_.head(parameters_) = mean_.head(parameters_).cwiseMax(margin).cwiseMin(1.0 - margin);
    if (walk_ > 0.0) {
      const double share =
          static_cast<double>(window_samples()) / static_cast<double>(std::max<std::size_t>(samples_, 1));
      covariance_.diagonal().head(parameters_).array() += walk_ * walk_ * share;
    }
    Tracked tracked{window_->recording, window_->end, {}, {}};
    for (Index k = 0; k < parameters_; ++k) {
      tracked.mean.push_back(mean_[k]);
      tracked.deviation.push_back(std::sqrt(covariance_(k, k)));
    }
    passing_.push_back(std::move(tracked));
  }

  // Lag-1 correlation of the innovations, within recordings.
  void note(const VectorXd& innovation) {
    for (Index k = 0; k < innovation.size(); ++k) {
      if (k > 0 || window_->begin > 0) {
        lag_product_ += before_ * innovation[k];
      }
      innovation_squares_ += innovation[k] * innovation[k];
      before_ = innovation[k];
    }
  }

  static constexpr double tolerance = 1e-4;

  Problem problem_;
  Index parameters_;
  std::size_t samples_ = 0;
  double spread_ = 0.0;
  double reach_ = 0.0;
  double walk_ = 0.0;
  double noise_ = 0.0;
  std::size_t block_ = 0;
  std::size_t passes_ = 0;

  VectorXd mean_;  // parameters, then states unless a recording begins
  MatrixXd covariance_;
  std::optional<Window> window_;  // none: the mean is being evaluated on all data
  MatrixXd sigma_;                // a column a point, centre first, then pairs
  VectorXd step_;                 // of every pair, in standard deviations
  VectorXd best_;
  double best_cost_ = 3.0 * diverged_cost;
  double innovation_squares_ = 0.0;
  double lag_product_ = 0.0;
  double before_ = 0.0;
  double correlation_ = 0.0;
  std::size_t spent_ = 0;
  std::size_t done_ = 0;   // passes
  std::size_t quiet_ = 0;  // passes in a row that gained nothing
  bool last_ = false;      // the budget does not reach to the end of the pass
  std::uint64_t draws_ = 0;
  std::vector<Tracked> passing_;  // of the pass under way
  std::vector<Tracked> track_;
  std::string reason_;
};

}  // namespace

const SolverEntry solver_ukf = {
    "ukf",
    "Unscented Kalman filter",
    "Julier and Uhlmann 2004, doi 10.1109/JPROC.2003.823141; Wan and van der Merwe 2000, doi "
    "10.1109/ASSPCC.2000.882463; Wu and Smyth 2007, doi 10.1002/stc.186",
    "Online identification: parameters and state variables followed through the recordings in time order, with bands "
    "of "
    "two standard deviations. A pass of L sigma points through all data counts L evaluations, and so on by windows. "
    "Repeats the pass until the noise level agrees with the misfit; with walk above 0 parameters may change with time, "
    "and the result is what holds at the end of the data.",
    false,
    settings,
    [](const Problem& problem) -> std::unique_ptr<Solver> { return std::make_unique<UnscentedKalmanFilter>(problem); }};

}  // namespace hysteron
