// Levenberg-Marquardt from one start: the problem's, else the centre of the box. See support/descent.hpp for equations
// and sources.
#include "algorithms/support/descent.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_lm;

namespace {

constexpr Setting settings[] = {
    {"tolerance", 1e-7, 1e-16, 0.1,
     "a descent ends when the squared cost falls by less than this share of itself twice"},
    longest_step_setting,
};

class LevenbergMarquardt final : public Solver {
 public:
  explicit LevenbergMarquardt(const Problem& problem)
      : descent_(start_of(problem), problem.linear, setting(problem, solver_lm, "tolerance"),
                 setting(problem, solver_lm, longest_step_setting.name)) {}

  Request ask() override {
    Request request;
    request.derivatives = true;
    if (!descent_.finished()) {
      request.points.assign(descent_.next().begin(), descent_.next().end());
    }
    return request;
  }
  void tell(const Request& /*request*/, const Response& response) override {
    if (response.cost.empty()) {
      return;
    }
    const auto d = descent_.next().size();
    descent_.tell(response.cost[0], response.cost[0] >= diverged_cost,
                  Eigen::Map<const Eigen::VectorXd>(response.gradient.data(), d),
                  Eigen::Map<const Eigen::MatrixXd>(response.gauss_newton.data(), d, d));
  }
  [[nodiscard]] std::string stopped_because() const override { return descent_.reason(); }

 private:
  static Eigen::VectorXd start_of(const Problem& problem) {
    if (!problem.start.empty()) {
      return Eigen::Map<const Eigen::VectorXd>(problem.start.data(), static_cast<Eigen::Index>(problem.start.size()));
    }
    return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(problem.dimension), 0.5);
  }

  Descent descent_;
};

}  // namespace

const SolverEntry solver_lm = {
    "lm",
    "Levenberg-Marquardt",
    "Marquardt 1963, doi 10.1137/0111030; More 1978, doi 10.1007/BFb0067700",
    "One bounded descent with exact derivatives; affine parameters projected out. Ends at the nearest local optimum.",
    true,
    settings,
    [](const Problem& problem) -> std::unique_ptr<Solver> {
      support::check_problem(problem, solver_lm);
      return std::make_unique<LevenbergMarquardt>(problem);
    }};

}  // namespace hysteron
