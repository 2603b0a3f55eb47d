#include "fit/target.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/drive.hpp"
#include "core/frequency.hpp"
#include "core/mean.hpp"
#include "fit/start.hpp"
#include "simulate/lean_motion.hpp"

namespace hysteron {

namespace {

bool conditions_vary(const Recording& recording) {
  return std::ranges::any_of(recording.conditions,
                             [](const ConditionChannel& condition) { return condition.values.size() > 1; });
}

Motion motion_of(const Recording& recording, double tolerance, bool lean) {
  std::vector<double> drive = quiet_drive(recording.drive);
  if (drive.empty() && conditions_vary(recording)) {
    drive.assign(recording.size(), 0.0);  // parameters are evaluated at every sample, at its drive
  }
  return (lean ? make_lean_motion : make_motion)(recording.time, recording.displacement, recording.velocity,
                                                 std::move(drive), tolerance, recording.derived_acceleration);
}

// What a march takes from the recording beside its motion.
void take_circumstances(const Recording& recording, Target& target) {
  target.earlier = recording.earlier;
  for (const ConditionChannel& condition : recording.conditions) {
    target.conditions.push_back(condition.values);
  }
}

// The measured force less its fastest noise: at each sample the parabola through the five samples around it.
std::vector<double> smoothed_force(const Recording& recording) {
  constexpr std::array<double, 5> weights = {-3.0 / 35.0, 12.0 / 35.0, 17.0 / 35.0, 12.0 / 35.0, -3.0 / 35.0};
  const std::vector<double>& force = recording.force;
  std::vector<double> result = force;
  for (std::size_t n = 2; n + 2 < force.size(); ++n) {
    result[n] = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      result[n] += weights[k] * force[n + k - 2];
    }
  }
  return result;
}

double fastest_of(const Motion& motion) {
  double result = 0.0;
  Motion piece;
  constexpr std::size_t at_once = 1000;
  for (std::size_t first = 0; is_lean(motion) && first + 1 < motion.time.size(); first += at_once) {
    prepare(motion, first, std::min(first + at_once + 1, motion.time.size()), piece);
    result = std::max(result, fastest_of(piece));
  }
  for (const MotionInterval& interval : motion.intervals) {
    result = std::max(result, interval.speed);
  }
  return result;
}

// The period to march beforehand, if any, so that the recording goes on from its end. Where the run-in does not count
// only a motion between turning points has one: of others little is lost with it, and a force that comes out of nothing
// under noise would be taken for one in its cycle.
void lead_in(Target& target, const Recording& recording, bool skip_run_in) {
  if (start_of(recording) != Start::from_nothing) {
    target.preroll = skip_run_in ? returns_after(recording, target.frequency) : period_of(recording, target.frequency);
  }
  if (target.preroll == 0) {
    return;
  }
  target.lead_in = beginning_of(target.motion, std::min(target.preroll + 1, recording.size()));
  target.motion.lead = target.lead_in.time.back();
}

// Samples a first look keeps: enough for the parameters, and for the shape of every period.
constexpr std::size_t screening_samples = 200;
constexpr double screening_samples_of_a_period = 100.0;

std::size_t screening_stride(const Recording& recording, double frequency) {
  const double step = (recording.time.back() - recording.time.front()) / static_cast<double>(recording.size() - 1);
  const double of_period = frequency > 0.0 ? 1.0 / (frequency * step * screening_samples_of_a_period) : 1.0;
  return std::max<std::size_t>(
      1, std::min(recording.size() / screening_samples, static_cast<std::size_t>(std::min(of_period, 1e6))));
}

// Whether the first force is far from the mean one: a motion that turns just there comes from somewhere, and brings its
// hysteresis along.
bool loaded_at_start(const Recording& recording) {
  constexpr std::size_t first = 5;
  constexpr double far = 0.1;  // of the largest force
  if (recording.force.size() < 4 * first) {
    return false;
  }
  const auto mean = [](auto from, auto to) { return std::accumulate(from, to, 0.0) / static_cast<double>(to - from); };
  const double all = mean(recording.force.begin(), recording.force.end());
  const double start = mean(recording.force.begin(), recording.force.begin() + first);
  double largest = 0.0;
  for (const double force : recording.force) {
    largest = std::max(largest, std::fabs(force - all));
  }
  return std::fabs(start - all) > far * largest;
}

// Samples until a motion that is under way at the first one has travelled a quarter of its range, by when hysteresis
// has forgotten where it started; 0 for a start from rest, and never more than a third of the recording.
std::size_t run_in_samples(const Recording& recording) {
  double peak = 0.0;
  for (const double velocity : recording.velocity) {
    peak = std::max(peak, std::fabs(velocity));
  }
  if (std::fabs(recording.velocity[0]) < 0.02 * peak && !loaded_at_start(recording)) {
    return 0;
  }
  const auto [low, high] = std::ranges::minmax(recording.displacement);
  double travelled = 0.0;
  std::size_t n = 0;
  while (n + 1 < recording.size() / 3 && travelled < 0.25 * (high - low)) {
    ++n;
    travelled += std::fabs(recording.displacement[n] - recording.displacement[n - 1]);
  }
  return n;
}

}  // namespace

Motion beginning_of(const Motion& motion, std::size_t count) {
  Motion result;
  if (is_lean(motion)) {
    prepare(motion, 0, count, result);
    return result;
  }
  copy_settings(motion, result);
  const auto first = [&](const auto& from, auto& to, std::size_t length) {
    to.assign(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(std::min(length, from.size())));
  };
  first(motion.time, result.time, count);
  first(motion.x, result.x, count);
  first(motion.v, result.v, count);
  first(motion.a, result.a, count);
  first(motion.jerk, result.jerk, count);
  first(motion.drive, result.drive, count);
  first(motion.load, result.load, count);
  first(motion.intervals, result.intervals, count - 1);
  result.beyond_corners = motion.beyond_corners;
  return result;
}

std::vector<double> Target::conditions_at(std::size_t n) const {
  std::vector<double> result;
  result.reserve(conditions.size());
  for (const std::vector<double>& values : conditions) {
    result.push_back(values.size() > 1 ? values[n] : values[0]);
  }
  return result;
}

Target make_target(const Recording& recording, const ObjectiveOptions& options) {
  return make_target(recording, options, recording.size() > options.most_prepared_samples);
}

Target make_target(const Recording& recording, const ObjectiveOptions& options, bool lean) {
  Target target;
  target.motion = motion_of(recording, options.tolerance, lean);
  if (options.under_measured_force) {
    target.motion.load = smoothed_force(recording);
  }
  target.fastest = fastest_of(target.motion);
  target.force = recording.force;
  target.frequency = dominant_frequency(recording);
  if (!recording.drive.empty()) {
    target.drive = mean_of(recording.drive);
    target.inputs_vary = drive_varies(recording);
  }
  take_circumstances(recording, target);
  target.inputs_vary = target.inputs_vary || conditions_vary(recording);
  lead_in(target, recording, options.skip_run_in);
  if (options.comparing) {
    target.lead_in = comparing_motion(std::move(target.lead_in));
    target.motion = comparing_motion(std::move(target.motion));
  }
  if (options.skip_run_in && target.preroll == 0) {
    target.run_in = run_in_samples(recording);
  }
  return target;
}

Target make_screening_target(const Target& full, const Recording& whole, const ObjectiveOptions& options) {
  const Recording recording = every_kth(whole, screening_stride(whole, full.frequency));
  Target target;
  target.normaliser = full.normaliser;
  target.weight = full.weight;
  target.frequency = full.frequency;
  target.drive = full.drive;
  take_circumstances(recording, target);
  target.inputs_vary = full.inputs_vary;
  target.motion = motion_of(recording, options.tolerance, false);
  target.fastest = fastest_of(target.motion);
  if (full.preroll > 0) {
    lead_in(target, recording, options.skip_run_in);
    target.lead_in = screening_motion(std::move(target.lead_in));
  }
  target.motion = screening_motion(std::move(target.motion));
  target.force = recording.force;
  target.run_in = full.run_in * target.force.size() / full.force.size();
  target.weight *=
      static_cast<double>(full.force.size() - full.run_in) / static_cast<double>(target.force.size() - target.run_in);
  return target;
}

}  // namespace hysteron
