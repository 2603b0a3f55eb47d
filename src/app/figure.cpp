#include "app/figure.hpp"

#include <cmath>
#include <numbers>

#include "datasets/dataset.hpp"
#include "fit/driver.hpp"
#include "fit/objective.hpp"
#include "report/figure.hpp"

namespace hysteron::app {
namespace {

constexpr double frequency = 2.0;  // Hz
constexpr std::size_t samples_of_period = 120;
constexpr std::size_t periods = 3;                      // the last one is shown
constexpr double amplitudes[] = {0.008, 0.016, 0.024};  // m
constexpr const char* amplitude_colours[] = {"#56b4e9", "#0072b2", "#d55e00"};

constexpr std::size_t figure_budget = 400;
constexpr std::uint64_t figure_seeds = 3;

Motion sine(double amplitude) {
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n <= periods * samples_of_period; ++n) {
    const double t = static_cast<double>(n) / (frequency * static_cast<double>(samples_of_period));
    time.push_back(t);
    x.push_back(amplitude * std::sin(omega * t));
    v.push_back(amplitude * omega * std::cos(omega * t));
  }
  return make_motion(time, x, v, {});
}

}  // namespace

std::string loop_figure(const Part& model) {
  const CompositeModel composite{&model, {}};
  std::vector<double> parameters;
  for (const Parameter& card : model.parameters) {
    parameters.push_back(card.initial);
  }
  FigurePanel by_displacement{"displacement [mm]", "force [N]", {}};
  FigurePanel by_velocity{"velocity [mm/s]", "force [N]", {}};
  for (std::size_t a = 0; a < std::size(amplitudes); ++a) {
    const Motion motion = sine(amplitudes[a]);
    const std::vector<double> force = simulate(composite, motion, parameters);
    FigureCurve loop;
    loop.colour = amplitude_colours[a];
    FigureCurve against_velocity = loop;
    for (std::size_t n = (periods - 1) * samples_of_period; n < force.size(); ++n) {
      loop.x.push_back(1e3 * motion.x[n]);
      loop.y.push_back(force[n]);
      against_velocity.x.push_back(1e3 * motion.v[n]);
      against_velocity.y.push_back(force[n]);
    }
    by_displacement.curves.push_back(std::move(loop));
    by_velocity.curves.push_back(std::move(against_velocity));
  }
  return figure_svg({by_displacement, by_velocity},
                    "Force of " + std::string(model.title) + " against displacement and velocity");
}

std::string convergence_figure(const SolverEntry& solver) {
  const DatasetEntry& dataset = *find_dataset("rd8040-twin");
  std::vector<Recording> recordings;
  for (Recording& recording : dataset.generate(Stream(1).child(dataset.id)).recordings) {
    if (recording.file == "2.0Hz_1.0A.csv") {
      recordings.push_back(std::move(recording));
    }
  }
  const Layout layout(make_model("bouc-wen", {}), scale_of(recordings), {});
  ObjectiveOptions options;
  options.threads = 1;
  const Objective objective(layout, recordings, options);
  FigurePanel panel{"evaluations", "NRMSE, best so far", {}, true};
  for (std::uint64_t seed = 1; seed <= figure_seeds; ++seed) {
    Problem problem;
    problem.dimension = layout.dimension();
    problem.budget = figure_budget;
    problem.stream = Stream(seed).child(solver.id);
    problem.linear = layout.linear();
    problem.screening = true;
    objective.describe_data(problem);
    for (std::size_t c = 0; c < layout.dimension(); ++c) {
      problem.start.push_back(Stream(seed).child("start").uniform(c));
    }
    const RunResult run =
        run_solver(solver, problem, [&](const Request& request) { return objective.evaluate(request); });
    FigureCurve curve;
    curve.width = 1.2;
    curve.step = true;
    for (const TracePoint& point : run.trace) {
      if (point.best < diverged_cost) {
        curve.x.push_back(static_cast<double>(point.evaluations));
        curve.y.push_back(point.best);
      }
    }
    if (!curve.x.empty()) {
      curve.x.push_back(static_cast<double>(figure_budget));
      curve.y.push_back(curve.y.back());
      panel.curves.push_back(std::move(curve));
    }
  }
  return figure_svg({panel}, "Convergence of " + std::string(solver.title) + " from " + std::to_string(figure_seeds) +
                                 " random starts");
}

}  // namespace hysteron::app
