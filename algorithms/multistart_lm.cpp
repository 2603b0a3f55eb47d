// Levenberg-Marquardt from many starts at once: eight descents a pack, random starts uniform in the unit box, the first
// from the problem's start. A descent that ends is replaced by a new one. Stops when `agreement` descents have ended
// within 1e-4 of the same best cost after at least `starts` descents, or at the budget.
// See support/descent.hpp for equations and sources; stopping by agreement follows Boender and Rinnooy Kan 1987,
// doi 10.1007/BF02592071, in spirit: the more descents end in the best optimum, the less likely a better one is unseen.
#include "algorithms/support/descent.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_multistart_lm;

namespace {

constexpr Setting settings[] = {
    {"width", 8.0, 1.0, 1024.0, "descents under way at once"},
    {"starts", 16.0, 1.0, 1e6, "descents ended before agreement may stop the run"},
    {"agreement", 3.0, 0.0, 1e6, "descents that must end at the best cost; 0 uses the whole budget"},
};

class MultistartLm final : public Solver {
 public:
  explicit MultistartLm(const Problem& problem) : problem_(problem) {
    support::check_problem(problem, solver_multistart_lm);
    starts_ = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "starts"));
    agreement_ = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "agreement"));
    const auto width = static_cast<std::size_t>(setting(problem, solver_multistart_lm, "width"));
    for (std::size_t k = 0; k < width; ++k) {
      descents_.emplace_back(start(), problem.linear);
    }
  }

  Request ask() override {
    Request request;
    request.derivatives = true;
    if (reason_.empty()) {
      for (const Descent& descent : descents_) {
        request.points.insert(request.points.end(), descent.next().begin(), descent.next().end());
      }
    }
    return request;
  }

  void tell(const Request& /*request*/, const Response& response) override {
    const auto d = static_cast<Eigen::Index>(problem_.dimension);
    for (std::size_t k = 0; k < response.cost.size(); ++k) {
      const auto offset = static_cast<Eigen::Index>(k) * d;
      descents_[k].tell(response.cost[k], response.cost[k] >= diverged_cost,
                        Eigen::Map<const Eigen::VectorXd>(response.gradient.data() + offset, d),
                        Eigen::Map<const Eigen::MatrixXd>(response.gauss_newton.data() + offset * d, d, d));
      if (descents_[k].finished()) {
        ended_.push_back(descents_[k].cost());
        descents_[k] = Descent(start(), problem_.linear);
      }
    }
    if (agreement_ == 0 || ended_.size() < starts_) {
      return;
    }
    const double best = *std::ranges::min_element(ended_);
    const auto agreeing = static_cast<std::size_t>(
        std::ranges::count_if(ended_, [&](double cost) { return cost <= best * (1.0 + 1e-4); }));
    if (agreeing >= agreement_) {
      reason_ = std::to_string(agreeing) + " of " + std::to_string(ended_.size()) +
                " descents ended within 1e-4 of the best cost";
    }
  }

  [[nodiscard]] std::string stopped_because() const override { return reason_; }

 private:
  Eigen::VectorXd start() {
    const std::size_t index = begun_++;
    Eigen::VectorXd point(static_cast<Eigen::Index>(problem_.dimension));
    for (std::size_t k = 0; k < problem_.dimension; ++k) {
      point[static_cast<Eigen::Index>(k)] = index == 0 && !problem_.start.empty()
                                                ? problem_.start[k]
                                                : problem_.stream.uniform(index, static_cast<std::uint32_t>(k));
    }
    return point;
  }

  Problem problem_;
  std::vector<Descent> descents_;
  std::vector<double> ended_;
  std::string reason_;
  std::size_t begun_ = 0;
  std::size_t starts_ = 0;
  std::size_t agreement_ = 0;
};

}  // namespace

const SolverEntry solver_multistart_lm = {
    "multistart-lm",
    "Multi-start Levenberg-Marquardt",
    "Marquardt 1963, doi 10.1137/0111030; Golub and Pereyra 1973, doi 10.1137/0710036",
    "Bounded descents with exact derivatives from many random starts, eight a pack; affine parameters projected out.",
    true,
    settings,
    [](const Problem& problem) -> std::unique_ptr<Solver> { return std::make_unique<MultistartLm>(problem); }};

}  // namespace hysteron
