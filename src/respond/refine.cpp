#include "respond/refine.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "fit/neighbours.hpp"
#include "fit/parallel.hpp"
#include "io/velocity.hpp"
#include "respond/respond.hpp"

namespace hysteron {
namespace {

constexpr double step_tolerance = 1e-9;  // of the simulated motion: below what differences of 1e-4 of the box resolve
constexpr double difference = 1e-4;      // of a coordinate of the unit box
// A start is looked for within this part of the largest displacement and velocity to either side of the first samples.
constexpr double span_of_start = 0.1;

struct MotionTarget {
  const Recording* recording;
  Excitation excitation;
  double frequency;
  double scale;    // largest |x|, m
  double fastest;  // largest |v|, m/s
};

MotionTarget prepared(const Recording& recording, const Rig& rig) {
  MotionTarget result{
      &recording, {}, dominant_frequency(recording), peak_of(recording.displacement), peak_of(recording.velocity)};
  if (!(result.scale > 0.0)) {
    throw InputError(recording.file + ": the mass does not move, expected a displacement to compare with");
  }
  result.excitation.time = recording.time;
  if (rig.base) {
    result.excitation.base = Signal(recording.time, recording.base, rig.interpolation, false);
  } else {
    result.excitation.force = Signal(recording.time, excitation_of(recording, rig), rig.interpolation, false);
  }
  if (!recording.drive.empty()) {
    result.excitation.drive = Signal(recording.time, quiet_drive(recording.drive), Interpolation::linear, false);
  }
  result.excitation.conditions = condition_signals(recording, false);
  return result;
}

// Displacement of the simulated motion; empty where it runs away.
std::vector<double> simulated(const Layout& layout, const std::vector<Term>& terms, const Rig& rig,
                              const MotionTarget& of, double displacement, double velocity) {
  Oscillator oscillator;
  oscillator.model = layout.model();
  oscillator.parameters = [&](double drive, std::span<const double> conditions) {
    return parameters_at(layout.held(), terms, drive, of.frequency, conditions);
  };
  oscillator.mass = rig.mass;
  oscillator.stiffness = rig.stiffness;
  oscillator.damping = rig.damping;
  RespondOptions with;
  with.tolerance = step_tolerance;
  with.displacement = displacement;
  with.velocity = velocity;
  try {
    return respond(oscillator, of.excitation, with).displacement;
  } catch (const WorkError&) {
    return {};
  }
}

// Difference of a simulated displacement and the recorded one over its largest, per sample; empty where the motion runs
// away.
std::vector<double> misfit(const std::vector<double>& displacement, const MotionTarget& of) {
  std::vector<double> result = displacement;
  for (std::size_t n = 0; n < result.size(); ++n) {
    result[n] = (result[n] - of.recording->displacement[n]) / of.scale;
    if (!std::isfinite(result[n])) {
      return {};
    }
  }
  return result;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value * value;
  }
  return sum / static_cast<double>(values.size());
}

// NRMSE of the displacement over the fitted recordings. Coordinates: those of the layout, then displacement and
// velocity at the start of each recording, as parts of their spans.
class ResponseObjective {
 public:
  ResponseObjective(const Layout& layout, const Rig& rig, std::vector<MotionTarget> targets, int threads)
      : layout_(layout), rig_(rig), targets_(std::move(targets)), threads_(threads) {}

  [[nodiscard]] std::size_t dimension() const { return layout_.dimension() + 2 * targets_.size(); }
  [[nodiscard]] std::size_t samples() const {
    std::size_t count = 0;
    for (const MotionTarget& one : targets_) {
      count += one.recording->size();
    }
    return count;
  }

  // Mean square of the recorded displacements, in the units of cost^2.
  [[nodiscard]] double measured_square() const {
    double sum = 0.0;
    for (const MotionTarget& one : targets_) {
      sum += mean_square(one.recording->displacement) / (one.scale * one.scale);
    }
    return sum / static_cast<double>(targets_.size());
  }

  [[nodiscard]] std::vector<double> misfit_of(const std::vector<double>& point, std::size_t r) const {
    return misfit(simulated_of(point, r), targets_[r]);
  }

  [[nodiscard]] std::vector<double> simulated_of(const std::vector<double>& point, std::size_t r) const {
    const MotionTarget& of = targets_[r];
    const std::size_t d = layout_.dimension();
    const auto about = [&](double middle, double largest, double unit) {
      return middle + span_of_start * largest * (2.0 * unit - 1.0);
    };
    return simulated(layout_, layout_.terms({point.begin(), point.begin() + static_cast<std::ptrdiff_t>(d)}), rig_, of,
                     about(of.recording->displacement[0], of.scale, point[d + 2 * r]),
                     about(of.recording->velocity[0], of.fastest, point[d + 2 * r + 1]));
  }

  [[nodiscard]] Response evaluate(const Request& request) const {
    const std::size_t d = dimension();
    const std::size_t count = request.points.size() / d;
    Response result;
    result.cost.resize(count);
    if (request.derivatives) {
      result.gradient.assign(count * d, 0.0);
      result.gauss_newton.assign(count * d * d, 0.0);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<double> point(request.points.begin() + static_cast<std::ptrdiff_t>(k * d),
                                      request.points.begin() + static_cast<std::ptrdiff_t>((k + 1) * d));
      result.cost[k] = request.derivatives ? linearised(point, &result.gradient[k * d], &result.gauss_newton[k * d * d])
                                           : linearised(point, nullptr, nullptr);
    }
    return result;
  }

 private:
  // A motion to simulate: recording r with coordinate c moved to `at`; no coordinate where c is the dimension.
  struct Task {
    std::size_t recording;
    std::size_t coordinate;
    double at;
  };

  // The cost; and adds J^T r and J^T J unless null.
  double linearised(const std::vector<double>& point, double* gradient, double* gauss_newton) const {
    const std::size_t d = dimension();
    const std::size_t shared = layout_.dimension();
    std::vector<Task> tasks;
    for (std::size_t r = 0; r < targets_.size(); ++r) {
      tasks.push_back({r, d, 0.0});
      for (std::size_t c = 0; c < d && gradient != nullptr; ++c) {
        if (c < shared || (c - shared) / 2 == r) {
          tasks.push_back({r, c, std::max(0.0, point[c] - difference)});
          tasks.push_back({r, c, std::min(1.0, point[c] + difference)});
        }
      }
    }
    std::vector<std::vector<double>> misfits(tasks.size());
    parallel_for(tasks.size(), threads_, [&](std::size_t t) {
      std::vector<double> moved = point;
      if (tasks[t].coordinate < d) {
        moved[tasks[t].coordinate] = tasks[t].at;
      }
      misfits[t] = misfit_of(moved, tasks[t].recording);
    });
    if (std::ranges::any_of(misfits, &std::vector<double>::empty)) {
      return diverged_cost;
    }
    double squares = 0.0;
    for (std::size_t t = 0; t < tasks.size();) {
      const std::size_t r = tasks[t].recording;
      const std::size_t here = t++;
      squares += mean_square(misfits[here]);
      if (gradient == nullptr) {
        continue;
      }
      const auto samples = static_cast<Eigen::Index>(misfits[here].size());
      const double weight = 1.0 / (static_cast<double>(samples) * static_cast<double>(targets_.size()));
      std::vector<std::size_t> moved;
      Eigen::MatrixXd jacobian(samples, static_cast<Eigen::Index>(shared + 2));
      for (; t < tasks.size() && tasks[t].recording == r; t += 2) {
        const double span = tasks[t + 1].at - tasks[t].at;
        const Eigen::Map<const Eigen::VectorXd> low(misfits[t].data(), samples);
        const Eigen::Map<const Eigen::VectorXd> high(misfits[t + 1].data(), samples);
        jacobian.col(static_cast<Eigen::Index>(moved.size())) = (high - low) / span;
        moved.push_back(tasks[t].coordinate);
      }
      const Eigen::VectorXd product =
          jacobian.transpose() * Eigen::Map<const Eigen::VectorXd>(misfits[here].data(), samples);
      const Eigen::MatrixXd square = jacobian.transpose() * jacobian;
      for (std::size_t a = 0; a < moved.size(); ++a) {
        gradient[moved[a]] += weight * product[static_cast<Eigen::Index>(a)];
        for (std::size_t b = 0; b < moved.size(); ++b) {
          gauss_newton[moved[a] * d + moved[b]] +=
              weight * square(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        }
      }
    }
    return std::sqrt(squares / static_cast<double>(targets_.size()));
  }

  const Layout& layout_;
  const Rig& rig_;
  std::vector<MotionTarget> targets_;
  int threads_;
};

std::vector<double> unit_point(const Layout& layout, const std::vector<Term>& terms) {
  std::vector<double> result(layout.dimension());
  for (const ParameterLaw& law : layout.laws()) {
    for (std::size_t k = 0; k < law.count(); ++k) {
      const ParameterLaw::Node node = law.node(k);
      const double value =
          parameters_at(layout.held(), terms, node.drive, node.frequency, node.conditions)[law.parameter];
      result[law.first + k] = std::clamp(layout.unit(law.first + k, value), 0.0, 1.0);
    }
  }
  return result;
}

// Derivatives by the first `kept` coordinates while the others follow.
Response without_starts(const Response& whole, std::size_t kept) {
  const auto d = static_cast<Eigen::Index>(whole.gradient.size());
  const auto n = static_cast<Eigen::Index>(kept);
  const Eigen::Map<const Eigen::MatrixXd> full(whole.gauss_newton.data(), d, d);
  const Eigen::MatrixXd across = full.topRightCorner(n, d - n);
  const Eigen::MatrixXd left =
      full.topLeftCorner(n, n) -
      across * full.bottomRightCorner(d - n, d - n).completeOrthogonalDecomposition().solve(across.transpose());
  Response result;
  result.cost = whole.cost;
  result.gradient.assign(whole.gradient.begin(), whole.gradient.begin() + n);
  result.gauss_newton.assign(left.data(), left.data() + left.size());
  return result;
}

}  // namespace

std::vector<double> excitation_of(const Recording& response, const Rig& rig) {
  if (!rig.base) {
    return response.force.empty() ? std::vector<double>(response.size(), 0.0) : response.force;
  }
  if (response.base.empty()) {
    throw InputError(response.file + ": no base column, expected the displacement of what the mass stands on");
  }
  std::vector<double> result =
      derive_acceleration(response.time, response.base, derive_velocity(response.time, response.base), false);
  for (double& value : result) {
    value *= -rig.mass;
  }
  return result;
}

void refuse_if_not_responding(const Layout& layout, const std::vector<Recording>& responses, const Rig& rig) {
  if (rig.base && rig.interpolation == Interpolation::linear) {
    throw OptionError(Option::interpolation +
                      " linear: straight lines of a base have no acceleration, expected cubic or band-limited");
  }
  constexpr double off_neutral = 0.6;  // of the box
  std::vector<double> p = layout.held();
  bool follows = false;
  for (const ParameterLaw& law : layout.laws()) {
    p[law.parameter] = layout.physical(law.first, off_neutral);
    follows = follows || law.drive_nodes.size() > 1;
  }
  for (const Recording& recording : responses) {
    require_response(layout.model(), p, follows && drive_varies(recording));
    prepared(recording, rig);
  }
}

std::vector<Recording> damper_recordings(const std::vector<Recording>& responses, const Rig& rig) {
  std::vector<Recording> result = responses;
  for (Recording& recording : result) {
    const std::vector<double>& acceleration =
        recording.acceleration.empty() ? recording.derived_acceleration : recording.acceleration;
    if (acceleration.size() != recording.size()) {
      throw InputError(recording.file + ": no acceleration can be had, expected more samples or its column");
    }
    recording.force = excitation_of(recording, rig);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.force[n] -=
          rig.mass * acceleration[n] + rig.damping * recording.velocity[n] + rig.stiffness * recording.displacement[n];
    }
  }
  return result;
}

ResponseFit refine(Identification& result, const std::vector<Recording>& responses, const Rig& rig,
                   const IdentifyOptions& options, const Observer& observer) {
  const Layout& layout = result.layout;
  std::vector<MotionTarget> fitted;
  for (const std::size_t k : result.fitted) {
    fitted.push_back(prepared(responses[k], rig));
  }
  const std::size_t count = fitted.size();
  const ResponseObjective objective(layout, rig, std::move(fitted), options.objective.threads);
  std::vector<double> point = unit_point(layout, result.terms);
  point.resize(objective.dimension(), 0.5);

  ResponseFit fit;
  fit.before = objective.evaluate({point, false}).cost[0];
  if (fit.before >= diverged_cost) {
    throw WorkError("the response simulated with the parameters of the equation of motion does not stay finite");
  }
  const SolverEntry& descent = *find_solver("lm");
  Problem problem;
  problem.dimension = objective.dimension();
  problem.budget = options.budget;
  problem.stream = Stream(options.seed).child("response").child(descent.id);
  problem.linear.assign(problem.dimension, false);
  problem.start = point;
  fit.run = run_solver(
      descent, problem, [&](const Request& request) { return objective.evaluate(request); }, observer);
  fit.cost = fit.before;
  if (!fit.run.best.empty() && fit.run.cost < fit.before) {
    point = fit.run.best;
    fit.cost = fit.run.cost;
  }
  const std::vector<double> shared(point.begin(), point.begin() + static_cast<std::ptrdiff_t>(layout.dimension()));
  result.terms = layout.terms(shared);

  NeighbourCorrelation pooled;
  for (std::size_t k = 0; k < count; ++k) {
    pooled.add(objective.misfit_of(point, k));
  }
  const double r = pooled.value();
  const double independent = static_cast<double>(objective.samples()) * (1.0 - r) / (1.0 + r);
  for (const std::string& stale : warnings_of(result.estimates)) {
    std::erase(result.warnings, stale);
  }
  result.estimates.clear();
  const Response derivatives = objective.evaluate({point, true});
  estimate(result, without_starts(derivatives, layout.dimension()), independent, shared, responses.front().drive_kind);
  result.sensitivities = sensitivities(layout, derivatives, objective.measured_square(), shared);

  for (std::string& warning : warnings_of(result.estimates)) {
    result.warnings.push_back(std::move(warning));
  }

  std::size_t next = 0;
  for (std::size_t k = 0; k < responses.size(); ++k) {
    const bool is_fitted = next < result.fitted.size() && result.fitted[next] == k;
    const MotionTarget of = prepared(responses[k], rig);
    std::vector<double> motion =
        is_fitted ? objective.simulated_of(point, next++)
                  : simulated(layout, result.terms, rig, of, responses[k].displacement[0], responses[k].velocity[0]);
    const std::vector<double> values = misfit(motion, of);
    const double nrmse = values.empty() ? std::nan("") : std::sqrt(mean_square(values));
    fit.scores.push_back({responses[k].file, nrmse, nrmse * of.scale});
    fit.motions.push_back({values.empty() ? std::vector<double>{} : std::move(motion)});
  }
  return fit;
}

}  // namespace hysteron
