#include "export/fixed_steps.hpp"

#include <algorithm>

#include "fit/march_inputs.hpp"
#include "fit/predict.hpp"
#include "simulate/lean_motion.hpp"
#include "simulate/march.hpp"

namespace hysteron {
namespace {

// c at from + width s as a polynomial in s.
void part_of(const double (&c)[4], double from, double width, double (&result)[4]) {
  result[0] = cubic(c, from);
  result[1] = width * cubic_slope(c, from);
  result[2] = width * width * (c[2] + 3.0 * c[3] * from);
  result[3] = width * width * width * c[3];
}

// Interval n of a motion cut into the steps that are to be taken over it, each an interval of its own that asks for no
// more than one; without an interval, sample n alone.
class Steps {
 public:
  Steps(const Motion& motion, int substeps) : motion_(motion), substeps_(substeps) {
    copy_settings(motion, piece_);
    piece_.most_substeps = 1.0;
  }

  const Motion& over(std::size_t n) {
    for (std::vector<double>* channel : {&piece_.time, &piece_.x, &piece_.v, &piece_.a, &piece_.jerk, &piece_.drive}) {
      channel->clear();
    }
    piece_.intervals.clear();
    if (n < motion_.intervals.size()) {
      const double split_at = motion_.intervals[n].split_at;
      cut(n, 0.0, split_at);
      cut(n, split_at, 1.0);
    }
    sample(n < motion_.intervals.size() ? n + 1 : n);
    return piece_;
  }

 private:
  void sample(std::size_t n) {
    add_sample(motion_.time[n], motion_.x[n], motion_.v[n], motion_.a[n], motion_.jerk[n],
               motion_.drive.empty() ? 0.0 : motion_.drive[n]);
  }

  void add_sample(double time, double x, double v, double a, double jerk, double drive) {
    piece_.time.push_back(time);
    piece_.x.push_back(x);
    piece_.v.push_back(v);
    piece_.a.push_back(a);
    piece_.jerk.push_back(jerk);
    if (!motion_.drive.empty()) piece_.drive.push_back(drive);
  }

  void cut(std::size_t n, double from, double to) {
    if (!(from < to)) return;
    const MotionInterval& whole = motion_.intervals[n];
    const MotionCourse& course = whole.course;  // a test vector has no corners
    const double width = (to - from) / substeps_;
    for (int k = 0; k < substeps_; ++k) {
      const double theta = from + width * k;
      MotionInterval step = whole;
      step.length = whole.length * width;
      part_of(course.x, theta, width, step.course.x);
      part_of(course.v, theta, width, step.course.v);
      part_of(whole.a, theta, width, step.a);
      const auto values_at = [&](double at, double(&values)[4]) {
        values[0] = cubic(step.course.x, at);
        values[1] = cubic(step.course.v, at);
        values[2] = cubic(step.a, at);
        values[3] = cubic_slope(step.a, at) / step.length;
      };
      values_at(0.5, step.middle);
      values_at(1.0, step.end);
      step.reversal = false;
      step.split_at = 1.0;
      piece_.intervals.push_back(step);
      if (theta == 0.0) {
        sample(n);
      } else {
        const double drive =
            motion_.drive.empty() ? 0.0 : motion_.drive[n] + (motion_.drive[n + 1] - motion_.drive[n]) * theta;
        add_sample(motion_.time[n] + whole.length * theta, step.course.x[0], step.course.v[0], step.a[0],
                   cubic_slope(step.a, 0.0) / step.length, drive);
      }
    }
  }

  const Motion& motion_;
  int substeps_;
  Motion piece_;
};

// Parameters that act at every sample of a motion, one row a sample.
class ActingParameters {
 public:
  ActingParameters(const ExportedModel& exported, double frequency)
      : exported_(exported), frequency_(frequency), inputs_(exported.model) {}

  std::vector<std::vector<double>> along(const Motion& motion) {
    std::vector<double> drive = motion.drive;
    drive.resize(motion.time.size());
    std::vector<std::vector<double>> result;
    for (std::size_t n = 0; n < motion.time.size(); ++n) {
      result.push_back(at(drive[n]));
      if (exported_.follows_drive() && !inputs_.none()) {
        result.back() = at(inputs_.act({motion.time, drive, n}, result.back().data()));
      }
    }
    return result;
  }

 private:
  [[nodiscard]] std::vector<double> at(double drive) const {
    return parameters_at(exported_.held, exported_.terms, drive, frequency_, {});
  }

  const ExportedModel& exported_;
  double frequency_;
  MarchInputs<double> inputs_;
};

// With series elements, whose balance starts from that of the step before: the march of simulate itself, held at its
// shortest steps by a stiffness that always asks for more.
std::vector<double> force_in_shortest_steps(const ExportedModel& exported, Target target) {
  constexpr double none_is_short_enough = 1e-200;
  for (Motion* motion : {&target.motion, &target.lead_in}) {
    motion->step_limit = none_is_short_enough;
    motion->most_substeps = exported.substeps;
  }
  return predict(exported.model, exported.held, exported.terms, target);
}

}  // namespace

std::vector<double> force_in_fixed_steps(const ExportedModel& exported, const Target& target) {
  const CompositeModel& model = exported.model;
  if (model.balances()) {
    return force_in_shortest_steps(exported, target);
  }
  std::vector<double> state(max_states, 0.0);
  ActingParameters parameters(exported, target.frequency);
  std::vector<double> between(model.parameter_count());
  std::vector<double> ignored;
  const auto march = [&](const Motion& motion, std::size_t samples, std::vector<double>* force) {
    const std::vector<std::vector<double>> acting = parameters.along(motion);
    Steps steps(motion, exported.substeps);
    for (std::size_t n = 0; n < samples; ++n) {
      const Motion& piece = steps.over(n);
      ignored.resize(piece.time.size());
      if (force != nullptr) {
        // At the sample its own parameters act, between two samples those in the middle.
        std::vector<double> at_sample = state;
        model.march<double>(piece, acting[n].data(), 0, 0, 1, at_sample.data(), &(*force)[n]);
      }
      if (piece.intervals.empty()) continue;
      for (std::size_t k = 0; k < between.size(); ++k) between[k] = 0.5 * (acting[n][k] + acting[n + 1][k]);
      model.march<double>(piece, between.data(), 0, 0, piece.intervals.size(), state.data(), ignored.data());
    }
  };
  if (target.preroll > 0) march(target.lead_in, target.preroll, nullptr);
  std::vector<double> force(target.motion.time.size());
  march(target.motion, force.size(), &force);
  return force;
}

}  // namespace hysteron
