#include "study/reproduce_recording.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "report/terminal.hpp"

namespace hysteron::reproduce {
namespace {

constexpr int samples_per_period = 100;
constexpr int periods = 3;
constexpr int settling_periods = 2;

}  // namespace

Recording sine_recording(const CompositeModel& model, const std::vector<double>& parameters, const std::string& name,
                         const SineTest& test, double noise) {
  Recording recording;
  recording.file = name;
  recording.drive_kind = test.kind;
  recording.velocity_measured = true;
  const double omega = 2.0 * std::numbers::pi * test.frequency;
  const int settled = settling_periods * samples_per_period;
  const int all = settled + periods * samples_per_period + 1;
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  std::vector<double> a;
  for (int n = 0; n < all; ++n) {
    time.push_back(n / (test.frequency * samples_per_period));
    x.push_back(test.amplitude * std::sin(omega * time.back()));
    v.push_back(test.amplitude * omega * std::cos(omega * time.back()));
    a.push_back(-omega * omega * x.back());
  }
  const std::vector<double> drive(time.size(), test.drive);
  const std::vector<double> force = simulate(model, make_motion(time, x, v, drive, 1e-8, a), parameters);
  double peak = 0.0;
  for (const double value : force) peak = std::max(peak, std::fabs(value));
  const Stream stream = Stream(1).child("round trip").child(name);
  for (int n = settled; n < all; ++n) {
    const auto k = static_cast<std::size_t>(n);
    recording.time.push_back(time[k] - time[static_cast<std::size_t>(settled)]);
    recording.displacement.push_back(x[k]);
    recording.velocity.push_back(v[k]);
    recording.derived_acceleration.push_back(a[k]);
    recording.force.push_back(force[k] + noise * peak * stream.normal(static_cast<std::uint64_t>(n)));
    recording.drive.push_back(test.drive);
  }
  return recording;
}

Study round_trip(const ReproduceOptions& options, const std::string& title) {
  Study study;
  study.title = title;
  study.solvers = {{"multistart-lm", "multistart-lm", {}, 0}};
  study.budgets = {options.budget};
  for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) study.seeds.push_back(seed);
  study.objective.tolerance = 1e-6;
  return study;
}

ModelSpec model_on(const std::string& label, const std::string& model, std::vector<std::string> on) {
  ModelSpec spec;
  spec.label = label;
  const auto plus = model.find('+');
  spec.model = model.substr(0, plus);
  if (plus != std::string::npos) spec.effects = {model.substr(plus + 1)};
  spec.on = std::move(on);
  return spec;
}

std::string deviation(double obtained, double published) {
  return published == 0.0 ? "-" : format_number(100.0 * (obtained - published) / published, 2);
}

double nrmse_on(const Plan& plan, std::size_t problem, const RunRecord& run, const Recording& unseen) {
  const Layout& layout = plan.problems[problem].layout;
  const auto force =
      predict(layout.model(), layout.held(), layout.terms(run.best), make_target(unseen, plan.study.objective));
  return score(force, unseen, plan.study.objective.normalisation).nrmse;
}

std::vector<double> polynomial_through(const std::vector<double>& x, const std::vector<double>& y, int order) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd design(n, order + 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (int power = 0; power <= order; ++power) design(k, power) = std::pow(x[static_cast<std::size_t>(k)], power);
  }
  const Eigen::VectorXd coefficients =
      design.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), n));
  return {coefficients.begin(), coefficients.end()};
}

}  // namespace hysteron::reproduce
