// Levenberg-Marquardt from many starts at once: up to `width` descents side by side, random starts uniform in the unit
// box, the first from the problem's start. A descent that ends is replaced by a new one. Stops when `agreement`
// descents have ended at the same best cost after at least `starts` descents, or at the budget. See support/descent.hpp
// for equations and sources; stopping by agreement follows Boender and Rinnooy Kan 1987, doi 10.1007/BF02591684, in
// spirit: the more descents end in the best optimum, the less likely a better one is unseen.
//
// Where the problem allows screening, descents are made on the coarse objective first, until the squared cost falls by
// less than 1e-2 of itself in two steps, or so little is foretold of the next. One that ends within 10 % of the best
// screened cost, or comes from the problem's start, and not within 0.5 % of one already taken further, is finished on
// the full objective from where it ended; agreement is then counted among screened costs, within 0.5 %, once every
// descent taken further has ended. Screening uses at most half of the budget. Without screening agreement is counted
// among final costs, within 1e-4.
//
// Descents side by side share the budget, and one that is cut short has found nothing. So there are no more of them
// than the budget holds to their end, at `descent_points` each, and screening needs the budget of `width` descents: the
// smallest budgets are one descent from the problem's start.
#include <algorithm>
#include <cmath>

#include "algorithms/support/descent.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_multistart_lm;

namespace {

constexpr Setting settings[] = {
    {"width", 4.0, 1.0, 1024.0, "descents under way at once, fewer where the budget does not hold them"},
    {"starts", 16.0, 1.0, 1e6, "descents ended before agreement may stop the run"},
    {"tolerance", 1e-7, 1e-16, 0.1,
     "a descent ends when the squared cost falls by less than this share of itself twice"},
    longest_step_setting,
    {"agreement", 3.0, 0.0, 1e6, "descents that must end at the best cost; 0 uses the whole budget"},
};

class MultistartLm final : public Solver {
 public:
  explicit MultistartLm(const Problem& problem) : problem_(problem) {
    support::check_problem(problem, solver_multistart_lm);
    starts_ = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "starts"));
    agreement_ = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "agreement"));
    width_ = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "width"));
    tolerance_ = setting(problem, solver_multistart_lm, "tolerance");
    longest_step_ = setting(problem, solver_multistart_lm, longest_step_setting.name);
    screening_ = problem.screening && affords(descent_points * width_);
    for (std::size_t k = 0; k < at_once(); ++k) {
      descents_.push_back(begin(begun_++));
    }
  }

  Request ask() override {
    Request request;
    request.derivatives = true;
    if (!reason_.empty()) {
      return request;
    }
    request.screening = screening_ && finishing_.empty();
    for (const Descent& descent : request.screening || !screening_ ? descents_ : finishing_) {
      request.points.insert(request.points.end(), descent.next().begin(), descent.next().end());
    }
    return request;
  }

  void tell(const Request& request, const Response& response) override {
    spent_ += response.cost.size();
    if (request.screening) {
      for (const double cost : response.cost) {
        lowest_ = std::min(lowest_, cost);
      }
    }
    std::vector<Descent>& told = screening_ && !request.screening ? finishing_ : descents_;
    for (std::size_t k = 0; k < response.cost.size(); ++k) {
      const auto d = static_cast<Eigen::Index>(problem_.dimension);
      const auto offset = static_cast<Eigen::Index>(k) * d;
      told[k].tell(response.cost[k], response.cost[k] >= diverged_cost,
                   Eigen::Map<const Eigen::VectorXd>(response.gradient.data() + offset, d),
                   Eigen::Map<const Eigen::MatrixXd>(response.gauss_newton.data() + offset * d, d, d));
    }
    if (&told == &finishing_) {
      std::erase_if(finishing_, [](const Descent& descent) { return descent.finished(); });
    } else {
      for (std::size_t k = 0; k < descents_.size(); ++k) {
        if (descents_[k].finished()) {
          end(descents_[k], k == 0 && !start_ended_ && !problem_.start.empty());
          start_ended_ = start_ended_ || k == 0;
          descents_[k] = begin(begun_++);
        }
      }
    }
    if (screening_ && finishing_.empty()) {
      // Parameters too stiff for coarse steps cannot be screened.
      screening_ = affords(2 * spent_) && (!ended_.empty() || diverged_ < starts_);
      if (!screening_) {
        // The rest of the budget on the full objective.
        ended_.clear();
        diverged_ = 0;
        descents_.clear();
        for (std::size_t k = 0; k < at_once(); ++k) {
          descents_.push_back(begin(k == 0 ? 0 : begun_++));
        }
      }
    }
    stop_if_agreed();
  }

  [[nodiscard]] std::string stopped_because() const override { return reason_; }
  [[nodiscard]] Ends ends() const override { return {ended_, diverged_, screening_, same()}; }

 private:
  static constexpr std::size_t descent_points = 16;  // fewer seldom end a descent
  static constexpr double screened_tolerance = 5e-3;

  [[nodiscard]] double same() const { return screening_ ? screened_tolerance : Ends{}.same; }
  [[nodiscard]] bool affords(std::size_t points) const { return points * (1 + problem_.dimension) <= problem_.budget; }
  // Descents that the rest of the budget holds to their end.
  [[nodiscard]] std::size_t at_once() const {
    const std::size_t points = problem_.budget / (1 + problem_.dimension);
    const std::size_t left = points > spent_ ? points - spent_ : 0;
    return std::clamp<std::size_t>(left / descent_points, 1, width_);
  }

  // A descent has ended; a screened one may go on where it ended, and that from the problem's start does.
  void end(const Descent& descent, bool from_start) {
    if (descent.best().size() == 0) {
      ++diverged_;
      if (screening_ && from_start) {
        // Too stiff for coarse steps, which says nothing of the problem's start on the full objective.
        finishing_.emplace_back(point_of(0), problem_.linear, tolerance_, longest_step_);
      }
      return;
    }
    ended_.push_back(descent.cost());
    if (!screening_) {
      return;
    }
    const double cost = descent.cost();
    const bool promising = cost <= 1.1 * lowest_;
    const bool known = std::ranges::any_of(
        taken_, [&](double other) { return std::fabs(cost - other) <= screened_tolerance * other; });
    if ((promising || from_start) && !known) {
      taken_.push_back(cost);
      finishing_.emplace_back(descent.best(), problem_.linear, tolerance_, longest_step_);
    }
  }

  void stop_if_agreed() {
    if (agreement_ == 0 || ended_.size() < starts_ || !finishing_.empty()) {
      return;
    }
    const double tolerance = same();
    const double best = *std::ranges::min_element(ended_);
    const auto agreeing = static_cast<std::size_t>(
        std::ranges::count_if(ended_, [&](double cost) { return cost <= best * (1.0 + tolerance); }));
    if (agreeing >= agreement_) {
      reason_ = std::to_string(agreeing) + " of " + std::to_string(ended_.size()) + " descents ended within " +
                support::number_text(tolerance) + " of the best" + (screening_ ? " screened cost" : " cost");
    }
  }

  // Where descent `index` begins.
  [[nodiscard]] Eigen::VectorXd point_of(std::size_t index) const {
    Eigen::VectorXd point(static_cast<Eigen::Index>(problem_.dimension));
    for (std::size_t k = 0; k < problem_.dimension; ++k) {
      point[static_cast<Eigen::Index>(k)] = index == 0 && !problem_.start.empty()
                                                ? problem_.start[k]
                                                : problem_.stream.uniform(index, static_cast<std::uint32_t>(k));
    }
    return point;
  }

  Descent begin(std::size_t index) {
    Eigen::VectorXd point = point_of(index);
    return screening_ ? Descent(std::move(point), problem_.linear, 1e-2, longest_step_, true)
                      : Descent(std::move(point), problem_.linear, tolerance_, longest_step_);
  }

  Problem problem_;
  std::vector<Descent> descents_;
  std::vector<Descent> finishing_;  // on the full objective after screening
  std::vector<double> ended_;
  std::vector<double> taken_;            // screened costs of those finished or being finished
  double lowest_ = 3.0 * diverged_cost;  // of all screened costs
  std::string reason_;
  bool start_ended_ = false;  // the descent from the problem's start
  std::size_t begun_ = 0;
  std::size_t spent_ = 0;  // points told
  std::size_t width_ = 0;
  std::size_t diverged_ = 0;  // descents whose start diverged
  std::size_t starts_ = 0;
  std::size_t agreement_ = 0;
  double tolerance_ = 0.0;
  double longest_step_ = 0.0;
  bool screening_ = false;
};

}  // namespace

const SolverEntry solver_multistart_lm = {
    "multistart-lm",
    "Multi-start Levenberg-Marquardt",
    "Marquardt 1963, doi 10.1137/0111030; Golub and Pereyra 1973, doi 10.1137/0710036",
    "Bounded descents with exact derivatives from many random starts, screened on a coarse objective first; affine "
    "parameters projected out.",
    true,
    settings,
    [](const Problem& problem) -> std::unique_ptr<Solver> { return std::make_unique<MultistartLm>(problem); }};

}  // namespace hysteron
