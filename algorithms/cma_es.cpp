// Covariance matrix adaptation evolution strategy with restarts (IPOP or BIPOP).
//
//   x_k = m + sigma B D z_k;   lambda = 4 + floor(3 ln n), mu = lambda / 2, w_i ~ ln(mu + 0.5) - ln i
//   ps <- (1-cs) ps + sqrt(cs (2-cs) mueff) C^-1/2 y_w;   pc <- (1-cc) pc + h sqrt(cc (2-cc) mueff) y_w
//   C  <- (1 - c1 - cmu sum w_i + (1-h) c1 cc (2-cc)) C + c1 pc pc' + cmu sum w_i y_i y_i'
//   The worse half has negative weights (active update), y_i there scaled to the length sqrt(n) in the metric of C.
//   sigma <- sigma exp((cs / damps) (|ps| / chiN - 1))
//
// Sources: N. Hansen, The CMA evolution strategy: a tutorial, arXiv 1604.00772 (all constants); A. Auger, N. Hansen,
//   Proc. CEC 2005, pp. 1769-1776, doi 10.1109/CEC.2005.1554902 (IPOP); N. Hansen, GECCO 2009 workshop, pp. 2389-2396,
//   doi 10.1145/1570256.1570333 (BIPOP).
// Deviations and choices:
// - `active` 0 leaves the negative weights out, as before the tutorial's version of 2016.
// - Bounds by mirroring: the strategy works on the even, periodic extension of the cost beyond the box and learns from
//   the unfolded points; only the folded point is evaluated. A minimum on a bound keeps its neighbourhood.
// - Restart rules (TolX, TolFun, EqualFunValues, Stagnation, ConditionCov, TolXUp, NoEffect) as in the tutorial; TolX =
//   1e-11 of the range, TolFun = 1e-12 in cost. TolXUp restarts when sigma times the longest axis exceeds 1e3.
// - The population is never larger than a tenth of what is left of the budget (but at least the default): a restart
//   that cannot adapt would waste it. Every restart starts at a uniform random mean, as in the sources.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_cma_es;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "offspring of the first run; 0: 4 + floor(3 ln n)"},
    {"sigma", 0.3, 1e-6, 2.0, "initial step size as a fraction of the range"},
    {"active", 1.0, 0.0, 1.0, "1 the worse half has negative weights, 0 it has none"},
    {"bipop", 1.0, 0.0, 1.0, "0 IPOP: double the population at each restart, 1 BIPOP: alternate large and small"},
};

class CovarianceStrategy final : public support::SamplingSolver {
 public:
  explicit CovarianceStrategy(const Problem& problem)
      : problem_(problem),
        n_(static_cast<Eigen::Index>(problem.dimension)),
        real_n_(static_cast<double>(problem.dimension)),
        first_sigma_(setting(problem, solver_cma_es, "sigma")),
        active_(support::whole_setting(problem, solver_cma_es, "active") == 1),
        bipop_(support::whole_setting(problem, solver_cma_es, "bipop") == 1),
        samples_(problem.stream.child("samples")),
        restarts_(problem.stream.child("restarts")) {
    default_lambda_ = support::whole_setting(problem, solver_cma_es, "population");
    if (default_lambda_ == 0) default_lambda_ = 4 + static_cast<std::size_t>(std::floor(3.0 * std::log(real_n_)));
    default_lambda_ = std::max<std::size_t>(default_lambda_, 4);
    large_lambda_ = default_lambda_;
    begin_run(default_lambda_, first_sigma_);
  }

  [[nodiscard]] Ends ends() const override { return ends_; }

 protected:
  std::vector<Point> propose() override {
    unfolded_.clear();
    std::vector<Point> points;
    for (std::size_t k = 0; k < lambda_; ++k) {
      Draws draws(samples_, generation_, k);
      Eigen::VectorXd z(n_);
      for (Eigen::Index d = 0; d < n_; ++d) z[d] = axis_length_[d] * draws.normal();
      unfolded_.emplace_back(mean_ + sigma_ * (axes_ * z));
      Point point(problem_.dimension);
      for (Eigen::Index d = 0; d < n_; ++d) point[static_cast<std::size_t>(d)] = support::mirror_unit(unfolded_[k][d]);
      points.push_back(std::move(point));
    }
    return points;
  }

  void accept(const std::vector<Point>& /*points*/, const std::vector<double>& cost) override {
    const std::vector<std::size_t> order = support::ascending(cost);
    update_distribution(order);
    ++generation_;
    ++run_generation_;
    run_evaluations_ += cost.size();
    // BIPOP: a small run may use half of what the last large run used.
    const bool exhausted = small_run_ && 2 * run_evaluations_ >= last_large_;
    if (run_finished(cost, order) || exhausted) restart();
  }

 private:
  void begin_run(std::size_t lambda, double sigma) {
    lambda_ = lambda;
    mu_ = lambda / 2;
    weights_.assign(mu_, 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < mu_; ++i) {
      weights_[i] = std::log(static_cast<double>(lambda) / 2.0 + 0.5) - std::log(static_cast<double>(i + 1));
      sum += weights_[i];
    }
    double square = 0.0;
    for (double& weight : weights_) {
      weight /= sum;
      square += weight * weight;
    }
    mueff_ = 1.0 / square;
    cc_ = (4.0 + mueff_ / real_n_) / (real_n_ + 4.0 + 2.0 * mueff_ / real_n_);
    cs_ = (mueff_ + 2.0) / (real_n_ + mueff_ + 5.0);
    c1_ = 2.0 / ((real_n_ + 1.3) * (real_n_ + 1.3) + mueff_);
    cmu_ = std::min(1.0 - c1_, 2.0 * (mueff_ - 1.75 + 1.0 / mueff_) / ((real_n_ + 2.0) * (real_n_ + 2.0) + mueff_));
    damps_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((mueff_ - 1.0) / (real_n_ + 1.0)) - 1.0) + cs_;
    expected_norm_ = std::sqrt(real_n_) * (1.0 - 1.0 / (4.0 * real_n_) + 1.0 / (21.0 * real_n_ * real_n_));

    weigh_the_worse();

    Draws draws(restarts_, run_, 0);
    Point start = support::random_point(draws, problem_.dimension);
    if (run_ == 0 && !problem_.start.empty()) start = support::clamped(problem_.start);
    mean_ = Eigen::Map<const Eigen::VectorXd>(start.data(), n_);
    sigma_ = sigma;
    covariance_ = Eigen::MatrixXd::Identity(n_, n_);
    axes_ = Eigen::MatrixXd::Identity(n_, n_);
    axis_length_ = Eigen::VectorXd::Ones(n_);
    path_sigma_ = Eigen::VectorXd::Zero(n_);
    path_c_ = Eigen::VectorXd::Zero(n_);
    run_generation_ = 0;
    run_evaluations_ = 0;
    since_decomposition_ = 0;
    recent_best_.clear();
    best_history_.clear();
    median_history_.clear();
    equal_history_.clear();
    decomposition_failed_ = false;
  }

  // Negative weights of the ranks beyond mu, equations 46 to 53 of the tutorial.
  void weigh_the_worse() {
    weights_of_worse_.clear();
    if (!active_) return;
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t i = mu_; i < lambda_; ++i) {
      const double weight = std::log(static_cast<double>(lambda_) / 2.0 + 0.5) - std::log(static_cast<double>(i + 1));
      weights_of_worse_.push_back(std::min(0.0, weight));
      sum -= weights_of_worse_.back();
      square += weights_of_worse_.back() * weights_of_worse_.back();
    }
    if (!(sum > 0.0)) return;
    const double mueff_of_worse = sum * sum / square;
    const double limit = std::min(
        {1.0 + c1_ / cmu_, 1.0 + 2.0 * mueff_of_worse / (mueff_ + 2.0), (1.0 - c1_ - cmu_) / (real_n_ * cmu_)});
    for (double& weight : weights_of_worse_) weight *= limit / sum;
  }

  void update_distribution(const std::vector<std::size_t>& order) {
    const Eigen::VectorXd old_mean = mean_;
    mean_.setZero();
    for (std::size_t i = 0; i < mu_; ++i) mean_ += weights_[i] * unfolded_[order[i]];
    const Eigen::VectorXd step = (mean_ - old_mean) / sigma_;
    const Eigen::VectorXd whitened = axes_ * (axes_.transpose() * step).cwiseQuotient(axis_length_);
    path_sigma_ = (1.0 - cs_) * path_sigma_ + std::sqrt(cs_ * (2.0 - cs_) * mueff_) * whitened;
    const double norm = path_sigma_.norm();
    const double settled = 1.0 - std::pow(1.0 - cs_, 2.0 * static_cast<double>(run_generation_ + 1));
    const bool h_sigma = norm / std::sqrt(settled) < (1.4 + 2.0 / (real_n_ + 1.0)) * expected_norm_;
    path_c_ = (1.0 - cc_) * path_c_;
    if (h_sigma) path_c_ += std::sqrt(cc_ * (2.0 - cc_) * mueff_) * step;
    double weight_sum = 1.0;
    for (const double weight : weights_of_worse_) weight_sum += weight;
    const double keep = 1.0 - c1_ - cmu_ * weight_sum + (h_sigma ? 0.0 : c1_ * cc_ * (2.0 - cc_));
    covariance_ = keep * covariance_ + c1_ * path_c_ * path_c_.transpose();
    for (std::size_t i = 0; i < mu_; ++i) {
      const Eigen::VectorXd y = (unfolded_[order[i]] - old_mean) / sigma_;
      covariance_ += cmu_ * weights_[i] * y * y.transpose();
    }
    for (std::size_t i = 0; i < weights_of_worse_.size(); ++i) {
      const Eigen::VectorXd y = (unfolded_[order[mu_ + i]] - old_mean) / sigma_;
      const double length_square = (axes_.transpose() * y).cwiseQuotient(axis_length_).squaredNorm();
      if (length_square > 0.0) {
        covariance_ += cmu_ * weights_of_worse_[i] * (real_n_ / length_square) * y * y.transpose();
      }
    }
    sigma_ *= std::exp(std::min(1.0, (cs_ / damps_) * (norm / expected_norm_ - 1.0)));

    // The decomposition is the expensive part: it is done only as often as C changes noticeably.
    since_decomposition_ += lambda_;
    if (static_cast<double>(since_decomposition_) > static_cast<double>(lambda_) / (c1_ + cmu_) / real_n_ / 10.0) {
      since_decomposition_ = 0;
      covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> decomposition(covariance_);
      if (decomposition.info() != Eigen::Success || !(decomposition.eigenvalues().minCoeff() > 0.0)) {
        decomposition_failed_ = true;
        return;
      }
      axes_ = decomposition.eigenvectors();
      axis_length_ = decomposition.eigenvalues().cwiseSqrt();
    }
  }

  bool run_finished(const std::vector<double>& cost, const std::vector<std::size_t>& order) {
    const double best = cost[order.front()];
    const double median = cost[order[lambda_ / 2]];
    const std::size_t horizon = 10 + static_cast<std::size_t>(std::ceil(30.0 * real_n_ / static_cast<double>(lambda_)));
    recent_best_.push_back(best);
    if (recent_best_.size() > horizon) recent_best_.pop_front();
    best_history_.push_back(best);
    median_history_.push_back(median);
    const std::size_t rank =
        std::min(lambda_ - 1, 1 + static_cast<std::size_t>(std::ceil(0.1 + static_cast<double>(lambda_) / 4.0)));
    equal_history_.push_back(best >= cost[order[rank]]);

    if (decomposition_failed_ || !std::isfinite(sigma_) || !mean_.allFinite()) return true;
    const double longest = axis_length_.maxCoeff();
    const double shortest = axis_length_.minCoeff();
    if (longest > 1e7 * shortest) return true;  // ConditionCov: 1e14
    if (sigma_ * longest > 1e3) return true;    // TolXUp
    const Eigen::VectorXd deviation = covariance_.diagonal().cwiseSqrt();
    if (sigma_ * std::max(deviation.maxCoeff(), path_c_.cwiseAbs().maxCoeff()) < 1e-11) return true;  // TolX
    if (recent_best_.size() == horizon) {  // TolFun, over the recent bests and the present generation
      const auto [low, high] = std::minmax_element(recent_best_.begin(), recent_best_.end());
      if (std::max(*high, cost[order.back()]) - std::min(*low, best) < 1e-12) return true;
    }
    if (equal_history_.size() > problem_.dimension + 4) {  // EqualFunValues: in more than a third of the last
      equal_history_.pop_front();
      const auto equal = std::count(equal_history_.begin(), equal_history_.end(), true);
      if (3 * static_cast<std::size_t>(equal) > equal_history_.size()) return true;
    }
    for (Eigen::Index d = 0; d < n_; ++d) {  // NoEffectCoord
      if (mean_[d] + 0.2 * sigma_ * deviation[d] <= mean_[d]) return true;
    }
    const auto axis = static_cast<Eigen::Index>(run_generation_ % problem_.dimension);  // NoEffectAxis
    if ((0.1 * sigma_ * axis_length_[axis] * axes_.col(axis) + mean_ - mean_).cwiseAbs().maxCoeff() <= 0.0) return true;
    return stagnated();
  }

  // Neither the bests nor the medians of the last 30 % of the history are better than those of its first 30 %.
  bool stagnated() const {
    const std::size_t needed = 120 + static_cast<std::size_t>(std::ceil(30.0 * real_n_ / static_cast<double>(lambda_)));
    if (run_generation_ < needed || run_generation_ % 10 != 0) return false;
    const std::size_t length =
        std::min<std::size_t>(20000, std::max(needed, static_cast<std::size_t>(run_generation_ / 5)));
    const auto not_better = [length](const std::vector<double>& history) {
      const std::size_t first = history.size() - std::min(length, history.size());
      const std::size_t part = std::max<std::size_t>(1, 3 * (history.size() - first) / 10);
      const auto median = [&history](std::size_t begin, std::size_t count) {
        std::vector<double> values(history.begin() + static_cast<std::ptrdiff_t>(begin),
                                   history.begin() + static_cast<std::ptrdiff_t>(begin + count));
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count / 2), values.end());
        return values[count / 2];
      };
      return median(history.size() - part, part) >= median(first, part);
    };
    return not_better(best_history_) && not_better(median_history_);
  }

  void restart() {
    ends_.add(*std::ranges::min_element(best_history_));
    const std::size_t left = problem_.budget > evaluations() ? problem_.budget - evaluations() : 0;
    const std::size_t cap = std::max(default_lambda_, left / 10);
    (small_run_ ? small_budget_ : large_budget_) += run_evaluations_;
    if (!small_run_) last_large_ = run_evaluations_;
    ++run_;
    // BIPOP: the regime that has used less of the budget goes next, the first restart being a large one.
    small_run_ = bipop_ && run_ > 1 && small_budget_ < large_budget_;
    if (!small_run_) {
      large_lambda_ = std::min(2 * large_lambda_, cap);
      begin_run(std::max(large_lambda_, default_lambda_), first_sigma_);
      return;
    }
    Draws draws(restarts_, run_, 1);
    const double exponent = draws.uniform();
    const double ratio = static_cast<double>(large_lambda_) / static_cast<double>(default_lambda_);
    const double size = static_cast<double>(default_lambda_) * std::pow(0.5 * ratio, exponent * exponent);
    const std::size_t lambda = std::max(default_lambda_, static_cast<std::size_t>(std::floor(size)));
    begin_run(std::min(lambda, cap), first_sigma_ * std::pow(10.0, -2.0 * draws.uniform()));
  }

  Problem problem_;
  Eigen::Index n_;
  double real_n_;
  double first_sigma_;
  bool active_;
  bool bipop_;
  Stream samples_;
  Stream restarts_;
  std::size_t default_lambda_ = 0;
  std::size_t large_lambda_ = 0;
  Ends ends_;

  // constants of the run
  std::size_t lambda_ = 0;
  std::size_t mu_ = 0;
  std::vector<double> weights_;
  std::vector<double> weights_of_worse_;  // empty without the active update
  double mueff_ = 0.0, cc_ = 0.0, cs_ = 0.0, c1_ = 0.0, cmu_ = 0.0, damps_ = 0.0, expected_norm_ = 0.0;

  // state of the run
  Eigen::VectorXd mean_;
  double sigma_ = 0.0;
  Eigen::MatrixXd covariance_;
  Eigen::MatrixXd axes_;
  Eigen::VectorXd axis_length_;
  Eigen::VectorXd path_sigma_;
  Eigen::VectorXd path_c_;
  std::vector<Eigen::VectorXd> unfolded_;
  std::size_t since_decomposition_ = 0;
  bool decomposition_failed_ = false;
  std::uint64_t run_generation_ = 0;
  std::size_t run_evaluations_ = 0;
  std::deque<double> recent_best_;
  std::vector<double> best_history_;
  std::vector<double> median_history_;
  std::deque<bool> equal_history_;

  // state over the runs
  std::uint64_t generation_ = 0;
  std::uint64_t run_ = 0;
  bool small_run_ = false;
  std::size_t small_budget_ = 0;
  std::size_t large_budget_ = 0;
  std::size_t last_large_ = 0;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_cma_es);
  return std::make_unique<CovarianceStrategy>(problem);
}

}  // namespace

const SolverEntry solver_cma_es = {
    "cma-es",
    "CMA-ES with IPOP or BIPOP restarts",
    "Hansen, The CMA evolution strategy: a tutorial, arXiv 1604.00772; Auger & Hansen, CEC 2005, doi\n"
    "10.1109/CEC.2005.1554902; Hansen, GECCO 2009, doi 10.1145/1570256.1570333",
    "Constants of the tutorial, with negative weights (active update). Bounds by mirroring: the strategy works on the "
    "even periodic\n"
    "extension of the cost. Converged or stagnated runs are restarted from random points with doubled population.",
    false,
    settings,
    make,
};

}  // namespace hysteron
