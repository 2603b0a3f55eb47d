// One Levenberg-Marquardt descent in the unit box, as a state machine: propose a point, be told cost, gradient and
// Gauss-Newton matrix there, propose the next.
//   minimise  g.s + s.(H + D/radius).s / 2   subject to  0 <= u + s <= 1,   D = diag(H)
// by an active set (components that would leave the box are put on it and the rest solved again).
// No coordinate that is not projected out moves further than `longest_step` of its box in a step: where the cost hardly
// depends on it, the step is long and the matrix tells nothing of what is there.
// Radius as in Ceres: grown by 1/max(1/3, 1 - (2 rho - 1)^3), shrunk by 2, 4, 8, ... on rejection.
// Coordinates in which the residual is affine are projected out (Golub and Pereyra 1973, doi 10.1137/0710036): at every
// point told, their optimum in the box is exact from the same matrices, and costs are compared there.
// Sources: Levenberg 1944; Marquardt 1963, doi 10.1137/0111030; More 1978, doi 10.1007/BFb0067700.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/support/settings.hpp"

namespace hysteron {

// Chosen among steps of an eighth of the box to the whole on training problems (results/longest-step.md).
inline constexpr Setting longest_step_setting = {"longest_step", 0.25, 1e-3, 1.0,
                                                 "share of its box that a parameter moves by in a step at most"};

class Descent {
 public:
  // Ends when the squared cost has fallen by less than `tolerance` of itself in two steps running. With a tolerance
  // below `polishing` steps are taken on even where they no longer show in the cost, which double precision leaves half
  // of the digits of the parameters, until they are shorter than a hundredth of the tolerance. One that anticipates
  // ends as soon as a step that the quadratic model foretold leaves it so little to gain, and counts that as gained.
  Descent(Eigen::VectorXd start, const std::vector<bool>& linear, double tolerance = 1e-7,
          double longest_step = longest_step_setting.value, bool anticipates = false)
      : next_(std::move(start)), tolerance_(tolerance), longest_step_(longest_step), anticipates_(anticipates) {
    for (std::size_t k = 0; k < linear.size(); ++k) {
      if (linear[k]) {
        linear_.push_back(static_cast<Eigen::Index>(k));
      }
    }
  }

  [[nodiscard]] const Eigen::VectorXd& next() const { return next_; }
  [[nodiscard]] bool finished() const { return !reason_.empty(); }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] double cost() const { return cost_; }
  // The best point told, with the affine coordinates at their optimum, or the one anticipated; empty before the first
  // finite cost.
  [[nodiscard]] const Eigen::VectorXd& best() const { return at_; }

  // `diverged` points count as rejected; a diverged start ends the descent.
  void tell(double cost, bool diverged, Eigen::VectorXd gradient, const Eigen::MatrixXd& matrix) {
    ++told_;
    if (diverged) {
      if (told_ == 1) {
        reason_ = "start diverged";
        return;
      }
      reject();
      return;
    }
    Eigen::VectorXd point = next_;
    const double raw = cost * cost;
    double squares = raw;
    project(point, squares, gradient, matrix);
    const bool first = told_ == 1;
    if (first && raw - squares > tolerance_ * raw) {
      // The other columns were taken at the start's values of the projected coordinates: take them again. Where nothing
      // else is left to fit, this is the only step, and only what is told counts.
      next_ = point;
      told_ = 1;
      best_squares_ = raw;
      settle_ = true;
      at_ = next_;
      gradient_ = gradient;
      matrix_ = matrix;
      cost_ = cost;
      return;
    }
    if (first || settle_ || squares < best_squares_ || too_small_to_show(squares)) {
      const double gained = first || settle_ ? 0.0 : best_squares_ - squares;
      const bool was_step = !(first || settle_);
      const bool hidden = was_step && too_small_to_show(squares);
      const double rho = predicted_ > 0.0 && !hidden ? gained / predicted_ : 1.0;
      at_ = point;
      gradient_ = gradient;
      matrix_ = matrix;
      const double before = best_squares_;
      best_squares_ = squares;
      cost_ = std::sqrt(squares);
      settle_ = false;
      if (was_step) {
        radius_ = std::min(1e12, radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * std::min(rho, 2.0) - 1.0, 3.0)));
        shrink_ = 2.0;
        quiet_ = gained < tolerance_ * before ? quiet_ + 1 : 0;
        const int enough = tolerance_ < polishing ? polishing_steps : 2;
        if (quiet_ >= enough) {
          reason_ = "relative decrease of the squared cost < " + support::number_text(tolerance_) +
                    (enough == 2 ? " twice" : " in " + std::to_string(enough) + " steps");
          return;
        }
      }
      step();
      if (anticipates_ && was_step && !finished() && rho > foretold && radius_ > undamped &&
          predicted_ < tolerance_ * best_squares_) {
        at_ = next_;
        best_squares_ -= predicted_;
        cost_ = std::sqrt(best_squares_);
        reason_ = "predicted decrease of the squared cost < " + support::number_text(tolerance_);
      }
    } else {
      reject();
    }
  }

 private:
  // Share of the predicted decrease that a step must bring, and radius above which damping is slight, for the quadratic
  // model to be trusted.
  static constexpr double foretold = 0.5;
  static constexpr double undamped = 10.0;
  static constexpr double polishing = 1e-10;
  static constexpr double rounding = 1e-13;  // of a squared cost
  static constexpr int polishing_steps = 20;

  // Both what the step should bring and what it brought are below the rounding of the cost.
  [[nodiscard]] bool too_small_to_show(double squares) const {
    return tolerance_ < polishing && predicted_ < rounding * best_squares_ &&
           squares <= best_squares_ * (1.0 + rounding);
  }

  void reject() {
    if (settle_) {
      settle_ = false;
    }
    radius_ /= shrink_;
    shrink_ *= 2.0;
    if (radius_ < 1e-12) {
      reason_ = "damping grew beyond 1e12 without a decrease";
      return;
    }
    step();
  }

  // Minimiser over the box of the quadratic with matrix A and gradient g from `point`, in the given coordinates.
  static Eigen::VectorXd bounded_step(const Eigen::MatrixXd& a, const Eigen::VectorXd& g,
                                      const Eigen::VectorXd& point) {
    const Eigen::Index d = g.size();
    Eigen::VectorXd s = Eigen::VectorXd::Zero(d);
    std::vector<char> held(static_cast<std::size_t>(d), 0);
    for (Eigen::Index pass = 0; pass <= d; ++pass) {
      std::vector<Eigen::Index> free;
      for (Eigen::Index k = 0; k < d; ++k) {
        if (held[static_cast<std::size_t>(k)] == 0) {
          free.push_back(k);
        }
      }
      if (free.empty()) {
        break;
      }
      const auto m = static_cast<Eigen::Index>(free.size());
      Eigen::MatrixXd sub(m, m);
      Eigen::VectorXd right(m);
      for (Eigen::Index i = 0; i < m; ++i) {
        right[i] = -g[free[static_cast<std::size_t>(i)]];
        for (Eigen::Index k = 0; k < d; ++k) {
          if (held[static_cast<std::size_t>(k)] != 0) {
            right[i] -= a(free[static_cast<std::size_t>(i)], k) * s[k];
          }
        }
        for (Eigen::Index j = 0; j < m; ++j) {
          sub(i, j) = a(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
        }
      }
      const Eigen::VectorXd solved = sub.ldlt().solve(right);
      bool moved = false;
      for (Eigen::Index i = 0; i < m; ++i) {
        const Eigen::Index k = free[static_cast<std::size_t>(i)];
        const double wanted = std::isfinite(solved[i]) ? point[k] + solved[i] : point[k];
        s[k] = std::clamp(wanted, 0.0, 1.0) - point[k];
        if (wanted < 0.0 || wanted > 1.0) {
          held[static_cast<std::size_t>(k)] = 1;
          moved = true;
        }
      }
      if (!moved) {
        break;
      }
    }
    return s;
  }

  // Moves the affine coordinates to their optimum in the box, with cost and gradient to match.
  void project(Eigen::VectorXd& point, double& squares, Eigen::VectorXd& gradient,
               const Eigen::MatrixXd& matrix) const {
    const auto m = static_cast<Eigen::Index>(linear_.size());
    if (m == 0) {
      return;
    }
    Eigen::MatrixXd sub(m, m);
    Eigen::VectorXd g(m);
    Eigen::VectorXd at(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index k = linear_[static_cast<std::size_t>(i)];
      g[i] = gradient[k];
      at[i] = point[k];
      for (Eigen::Index j = 0; j < m; ++j) {
        sub(i, j) = matrix(k, linear_[static_cast<std::size_t>(j)]);
      }
    }
    sub.diagonal() *= 1.0 + 1e-12;
    const Eigen::VectorXd s = bounded_step(sub, g, at);
    const double change = 2.0 * g.dot(s) + s.dot(sub * s);
    if (!(change < 0.0) || squares + change <= 0.0) {
      return;
    }
    squares += change;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index k = linear_[static_cast<std::size_t>(i)];
      point[k] += s[i];
      gradient += matrix.col(k) * s[i];
    }
  }

  // Farthest that a coordinate moves which is not projected out.
  [[nodiscard]] double longest(const Eigen::VectorXd& s) const {
    Eigen::VectorXd moved = s.cwiseAbs();
    for (const Eigen::Index k : linear_) {
      moved[k] = 0.0;
    }
    return std::max(moved.maxCoeff(), 1e-300);
  }

  void step() {
    for (int attempt = 0; attempt < 60; ++attempt) {
      Eigen::MatrixXd damped = matrix_;
      for (Eigen::Index k = 0; k < damped.rows(); ++k) {
        damped(k, k) += std::max(matrix_(k, k), 1e-12) / radius_;
      }
      Eigen::VectorXd s = bounded_step(damped, gradient_, at_);
      s *= std::min(1.0, longest_step_ / longest(s));
      predicted_ = -(2.0 * gradient_.dot(s) + s.dot(matrix_ * s));
      const double shortest = std::min(1e-9, 0.01 * tolerance_);
      if (s.lpNorm<Eigen::Infinity>() < shortest) {
        reason_ = "step < " + support::number_text(shortest) + " of the box";
        return;
      }
      if (predicted_ > 0.0) {
        next_ = at_ + s;
        return;
      }
      radius_ /= 4.0;
    }
    reason_ = "no descent direction";
  }

  std::vector<Eigen::Index> linear_;
  Eigen::VectorXd next_;
  Eigen::VectorXd at_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd matrix_;
  std::string reason_;
  double tolerance_;
  double longest_step_;
  bool anticipates_;
  double best_squares_ = 0.0;
  double cost_ = 1e300;
  double radius_ = 10.0;
  double shrink_ = 2.0;
  double predicted_ = 0.0;
  int quiet_ = 0;
  int told_ = 0;
  bool settle_ = false;
};

}  // namespace hysteron
