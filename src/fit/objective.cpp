#include "fit/objective.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "fit/parallel.hpp"
#include "fit/start.hpp"
#include "simulate/march.hpp"

namespace hysteron {
namespace {

constexpr std::size_t block_samples = 128;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// A pack of candidates: their rows in the request, at most one a lane.
using Rows = std::span<const std::size_t>;

// Lanes of coordinate c: physical values, or their slopes with the unit coordinate. Lane l holds candidate of(l).
template <class Of>
Lanes lanes_of(const std::vector<double>& points, Rows rows, const Layout& layout, std::size_t c, bool slope, Of&& of) {
  Lanes result;
  for (int lane = 0; lane < lane_count; ++lane) {
    const double u = points[rows[of(static_cast<std::size_t>(lane))] * layout.dimension() + c];
    result.set_lane(lane, slope ? layout.slope(c, u) : layout.physical(c, u));
  }
  return result;
}

// Parameters of a pack at one drive level: nodes weighted by the law. For duals, the directions of this sweep are the
// coordinates [sweep, sweep + sweep_directions).
template <class T, class Drive>
void parameters_of_pack(const Layout& layout, const std::vector<T>& nodes, const Drive& drive, double frequency, T* p) {
  for (std::size_t j = 0; j < layout.cards().size(); ++j) {
    p[j] = T(layout.held()[j]);
  }
  for (const ParameterLaw& law : layout.laws()) {
    const std::vector<Drive> weights = Layout::weights<Drive>(law, drive, frequency);
    T value = T(weights[0]) * nodes[law.first];
    for (std::size_t k = 1; k < weights.size(); ++k) {
      value = fma(T(weights[k]), nodes[law.first + k], value);
    }
    p[law.parameter] = weights.size() == 1 ? nodes[law.first] : value;
  }
}

// The effects that change the drive before the laws of the parameters are evaluated (PartOperations::recall and
// ::excite), in time order over the samples of a recording.
template <class T>
class Excitation {
 public:
  explicit Excitation(const CompositeModel& model) {
    model.for_links([this](const Link& link) {
      const PartOperations<T>& part = link.part->on<T>();
      // Outermost first, but what recalls the recording before all.
      if (part.recall != nullptr) recalls_.insert(recalls_.begin(), {part.recall, link.parameter});
      if (part.excite != nullptr) parts_.insert(parts_.begin(), {part.excite, link.parameter, {}});
    });
  }
  [[nodiscard]] bool none() const { return recalls_.empty() && parts_.empty(); }
  // Drive that acts at a sample whose parameters at the recorded drive are p.
  T act(const Command& command, const T* p) {
    T result(command.drive[command.at]);
    for (const Recall& part : recalls_) {
      part.recall(p + part.parameter, command, result);
    }
    for (Step& part : parts_) {
      part.excite(p + part.parameter, part.memory.data(), command.elapsed(), result);
    }
    return result;
  }

 private:
  struct Recall {
    decltype(PartOperations<T>::recall) recall;
    std::size_t parameter;
  };
  struct Step {
    decltype(PartOperations<T>::excite) excite;
    std::size_t parameter;
    std::array<T, excitation_memory> memory;
  };
  std::vector<Recall> recalls_;
  std::vector<Step> parts_;
};

// Marches samples [first, last) of a target block by block and hands (first sample, count, force) to the sink, those of
// the period marched beforehand to the other one. `state` holds max_states: those at the first sample, then those at
// the last; a march that begins the target starts from rest, whatever it held.
template <class T, class Parameters, class Sink, class Before>
void march_window(const CompositeModel& model, const Target& target, const Parameters& parameters_at_drive,
                  std::size_t first, std::size_t last, std::vector<T>& state, Sink&& sink, Before&& before) {
  const std::size_t width = model.parameter_count();
  const std::size_t stride = target.drive_varies ? width : 0;
  std::vector<T> p(target.drive_varies ? width * (block_samples + 1) : width);
  std::vector<T> out(block_samples);
  Excitation<T> excitation(model);
  const auto parameters_of = [&](const Command& command, T* values) {
    parameters_at_drive(command.drive[command.at], values);
    if (!excitation.none()) {
      parameters_at_drive(excitation.act(command, values), values);
    }
  };
  // Effects on the drive remember: every sample is asked once, and the one that ends a block begins the next.
  const auto block = [&](const Motion& motion, std::size_t begin, std::size_t end, bool goes_on) {
    if (target.drive_varies) {
      if (goes_on) {
        std::copy_n(p.data() + block_samples * width, width, p.data());
      }
      for (std::size_t n = begin + (goes_on ? 1 : 0); n < std::min(end + 1, motion.time.size()); ++n) {
        parameters_of({motion.time, motion.drive, n}, p.data() + (n - begin) * width);
      }
    }
    model.march<T>(motion, p.data(), stride, begin, end, state.data(), out.data());
  };
  if (!target.drive_varies) {
    const double instant = 0.0;
    parameters_of({{&instant, 1}, {&target.drive, 1}, 0}, p.data());
  }
  if (first == 0) {
    std::ranges::fill(state, T(0.0));
    for (std::size_t begin = 0; begin < target.preroll; begin += block_samples) {
      const std::size_t end = std::min(begin + block_samples, target.preroll);
      block(target.lead_in, begin, end, begin > 0);
      before(begin, end - begin, out.data());
    }
  } else if (target.drive_varies && !excitation.none()) {
    // What the effects on the drive remember, from the start of the recording.
    for (std::size_t n = 0; n < first; ++n) {
      parameters_of({target.motion.time, target.motion.drive, n}, p.data());
    }
  }
  for (std::size_t begin = first; begin < last; begin += block_samples) {
    const std::size_t end = std::min(begin + block_samples, last);
    block(target.motion, begin, end, begin > first);
    sink(begin, end - begin, out.data());
  }
}

// The whole target.
template <class T, class Parameters, class Sink, class Before>
void march_target(const CompositeModel& model, const Target& target, const Parameters& parameters_at_drive, Sink&& sink,
                  Before&& before) {
  std::vector<T> state(max_states);
  march_window<T>(model, target, parameters_at_drive, 0, target.force.size(), state, sink, before);
}

Motion motion_of(const Recording& recording, double tolerance) {
  return make_motion(recording.time, recording.displacement, recording.velocity, quiet_drive(recording.drive),
                     tolerance, recording.derived_acceleration);
}

// The period to march beforehand, if any, so that the recording goes on from its end.
void lead_in(Target& target, const Recording& recording) {
  target.preroll = start_of(recording) == Start::from_nothing ? 0 : returns_after(recording, target.frequency);
  if (target.preroll == 0) {
    return;
  }
  target.lead_in = target.motion;
  const std::size_t count = std::min(target.preroll + 1, recording.size());
  for (std::vector<double>* channel : {&target.lead_in.time, &target.lead_in.x, &target.lead_in.v, &target.lead_in.a,
                                       &target.lead_in.jerk, &target.lead_in.drive}) {
    channel->resize(std::min(count, channel->size()));
  }
  target.lead_in.intervals.resize(count - 1);
  target.motion.lead = target.lead_in.time.back();
}

// Sum over the parts of their bounds of |d rate / d state|, 1/s. A series element has none of its own: its state is
// solved for together with the force.
double stiffness_bound(const CompositeModel& model, const double* p, double speed) {
  double bound = 0.0;
  model.for_links([&](const Link& link) {
    const auto stiffness = link.part->on_double.stiffness;
    if (stiffness != nullptr) bound += stiffness(p + link.parameter, speed);
  });
  return bound;
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

Normalisation normalisation_of(const std::string& word) {
  if (word == "max-abs") {
    return Normalisation::max_abs;
  }
  if (word == "range") {
    return Normalisation::range;
  }
  if (word == "std") {
    return Normalisation::standard_deviation;
  }
  if (word == "mean-abs") {
    return Normalisation::mean_abs;
  }
  throw InputError("--normalisation: unknown '" + word + "', expected max-abs, range, std or mean-abs");
}

std::string_view word_of(Normalisation normalisation) {
  switch (normalisation) {
    case Normalisation::range:
      return "range";
    case Normalisation::standard_deviation:
      return "std";
    case Normalisation::mean_abs:
      return "mean-abs";
    case Normalisation::max_abs:
      break;
  }
  return "max-abs";
}

double normaliser(const Recording& recording, Normalisation normalisation) {
  double result = 0.0;
  switch (normalisation) {
    case Normalisation::max_abs:
      for (const double force : recording.force) {
        result = std::max(result, std::fabs(force));
      }
      break;
    case Normalisation::range: {
      const auto [low, high] = std::ranges::minmax(recording.force);
      result = high - low;
      break;
    }
    case Normalisation::standard_deviation:
      result = standard_deviation(recording.force);
      break;
    case Normalisation::mean_abs:
      for (const double force : recording.force) {
        result += std::fabs(force);
      }
      result /= static_cast<double>(recording.force.size());
      break;
  }
  if (!(result > 0.0)) {
    throw InputError(recording.file, 0,
                     "the force is zero or constant throughout, expected a signal to normalise by (" +
                         std::string(word_of(normalisation)) + ")");
  }
  return result;
}

Target make_target(const Recording& recording, const ObjectiveOptions& options) {
  Target target;
  target.motion = motion_of(recording, options.tolerance);
  target.force = recording.force;
  target.frequency = dominant_frequency(recording);
  if (!recording.drive.empty()) {
    target.drive = mean_of(recording.drive);
    target.drive_varies = drive_varies(recording);
  }
  lead_in(target, recording);
  if (options.comparing) {
    target.lead_in = comparing_motion(std::move(target.lead_in));
    target.motion = comparing_motion(std::move(target.motion));
  }
  if (options.skip_run_in && target.preroll == 0) {
    target.run_in = run_in_samples(recording);
  }
  return target;
}

Objective::Objective(const Layout& layout, const std::vector<Recording>& recordings, const ObjectiveOptions& options)
    : layout_(layout), threads_(options.threads), stopped_(options.stopped) {
  double total = 0.0;
  double pooled_normaliser = 0.0;
  for (const Recording& recording : recordings) {
    Target target = make_target(recording, options);
    target.normaliser = normaliser(recording, options.normalisation);
    pooled_normaliser = std::max(pooled_normaliser, target.normaliser);
    total += static_cast<double>(recording.size() - target.run_in);
    targets_.push_back(std::move(target));
  }
  for (Target& target : targets_) {
    if (options.weighting == Weighting::pooled) {
      target.weight = 1.0 / (total * pooled_normaliser * pooled_normaliser);
    } else {
      target.weight = 1.0 / (static_cast<double>(target.force.size() - target.run_in) *
                             static_cast<double>(targets_.size()) * target.normaliser * target.normaliser);
    }
  }
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Target& full = targets_[k];
    const Recording recording = every_kth(recordings[k], screening_stride(recordings[k], full.frequency));
    Target target = full;
    target.motion = motion_of(recording, options.tolerance);
    target.preroll = 0;
    if (full.preroll > 0) {
      lead_in(target, recording);
      target.lead_in = screening_motion(std::move(target.lead_in));
    }
    target.motion = screening_motion(std::move(target.motion));
    target.force = recording.force;
    target.run_in = full.run_in * target.force.size() / full.force.size();
    target.weight *=
        static_cast<double>(full.force.size() - full.run_in) / static_cast<double>(target.force.size() - target.run_in);
    screening_targets_.push_back(std::move(target));
  }
}

std::size_t Objective::samples() const {
  std::size_t total = 0;
  for (const Target& target : targets_) {
    total += target.force.size();
  }
  return total;
}

namespace {

// What a task of one pack and one target returns: weighted sum of squares and samples alive, then gradient and upper
// triangle of the Gauss-Newton matrix, each for eight lanes.
std::size_t sums_size(std::size_t dimension, bool derivatives) {
  return 2 + (derivatives ? dimension + dimension * (dimension + 1) / 2 : 0);
}

}  // namespace

void Objective::check_stopped() const {
  if (stopped_ && stopped_()) {
    throw Stopped{};
  }
}

template <>
void Objective::run_pack<Lanes>(const std::vector<double>& points, Rows rows, const Target& target,
                                double* sums) const {
  const std::size_t d = layout_.dimension();
  const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
  std::vector<Lanes> nodes(d);
  for (std::size_t c = 0; c < d; ++c) {
    nodes[c] = lanes_of(points, rows, layout_, c, false, candidate);
  }
  const Lanes limit(1e12 * target.normaliser);
  Lanes squares;
  Lanes alive;
  march_target<Lanes>(
      layout_.model(), target,
      [&](const auto& drive, Lanes* p) { parameters_of_pack(layout_, nodes, drive, target.frequency, p); },
      [&](std::size_t begin, std::size_t samples, const Lanes* out) {
        check_stopped();
        for (std::size_t k = 0; k < samples; ++k) {
          const Lanes residual = out[k] - Lanes(target.force[begin + k]);
          if (begin + k >= target.run_in) {
            squares = fma(residual, residual, squares);
          }
          alive += select(abs(residual) < limit, Lanes(1.0), Lanes(0.0));
        }
      },
      [&](std::size_t begin, std::size_t samples, const Lanes* out) {
        for (std::size_t k = 0; k < samples; ++k) {
          alive += select(abs(out[k] - Lanes(target.force[begin + k])) < limit, Lanes(1.0), Lanes(0.0));
        }
      });
  for (int lane = 0; lane < lane_count; ++lane) {
    sums[lane] = squares.lane(lane) * target.weight;
    sums[lane_count + lane] = alive.lane(lane);
  }
}

// A sweep differentiates sweep_directions coordinates. The pairs of candidate and sweep are dealt to the lanes, so that
// few candidates with many coordinates fill a pack too.
Objective::PackSums Objective::differentiated(const std::vector<double>& points, Rows rows, const Target& target,
                                              const TakeDerivatives& take) const {
  const std::size_t d = layout_.dimension();
  const std::size_t count = rows.size();
  const std::size_t pairs = count * ((d + sweep_directions - 1) / sweep_directions);
  const std::size_t samples = target.force.size();
  const Lanes limit(1e12 * target.normaliser);
  PackSums result;
  Lanes& squares = result.squares;
  Lanes& alive = result.alive;
  // One march has all the columns of a block at once; the columns of several are put together first.
  const bool together = pairs <= lane_count;
  std::vector<Lanes> jacobian((together ? block_samples : samples) * d);
  std::vector<Lanes> residual(together ? block_samples : samples);
  std::vector<LaneDual> nodes(d);
  for (std::size_t first = 0; first < pairs; first += lane_count) {
    const auto pair = [&](std::size_t lane) { return std::min(first + lane, pairs - 1); };
    const auto low = [&](std::size_t lane) { return pair(lane) / count * sweep_directions; };
    const auto candidate = [&](std::size_t lane) { return pair(lane) % count; };
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = LaneDual(lanes_of(points, rows, layout_, c, false, candidate));
      const Lanes slope = lanes_of(points, rows, layout_, c, true, candidate);
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (c >= low(lane) && c < low(lane) + sweep_directions) {
          nodes[c].d[c - low(lane)].set_lane(static_cast<int>(lane), slope.lane(static_cast<int>(lane)));
        }
      }
    }
    const std::size_t used = std::min<std::size_t>(lane_count, pairs - first);
    march_target<LaneDual>(
        layout_.model(), target,
        [&](const auto& drive, LaneDual* p) { parameters_of_pack(layout_, nodes, drive, target.frequency, p); },
        [&](std::size_t begin, std::size_t block, const LaneDual* out) {
          check_stopped();
          const std::size_t base = together ? 0 : begin;
          for (std::size_t k = 0; k < block; ++k) {
            Lanes* row = jacobian.data() + (base + k) * d;
            if (count == lane_count) {
              for (std::size_t c = low(0); c < std::min(low(0) + sweep_directions, d); ++c) {
                row[c] = out[k].d[c - low(0)];
              }
            } else {
              for (std::size_t lane = 0; lane < used; ++lane) {
                for (std::size_t c = low(lane); c < std::min(low(lane) + sweep_directions, d); ++c) {
                  row[c].set_lane(static_cast<int>(candidate(lane)),
                                  out[k].d[c - low(lane)].lane(static_cast<int>(lane)));
                }
              }
            }
            if (first == 0) {
              // The lanes of the first sweep are the candidates in order.
              const Lanes r = out[k].v - Lanes(target.force[begin + k]);
              residual[base + k] = r;
              if (begin + k >= target.run_in) {
                squares = fma(r, r, squares);
              }
              alive += select(abs(r) < limit, Lanes(1.0), Lanes(0.0));
            }
          }
          if (together) {
            take(begin, block, jacobian.data(), residual.data());
          }
        },
        [&](std::size_t begin, std::size_t block, const LaneDual* out) {
          for (std::size_t k = 0; first == 0 && k < block; ++k) {
            alive += select(abs(out[k].v - Lanes(target.force[begin + k])) < limit, Lanes(1.0), Lanes(0.0));
          }
        });
  }
  if (!together) {
    take(0, samples, jacobian.data(), residual.data());
  }
  return result;
}

template <>
void Objective::run_pack<LaneDual>(const std::vector<double>& points, Rows rows, const Target& target,
                                   double* sums) const {
  const std::size_t d = layout_.dimension();
  std::vector<Lanes> gradient(d);
  std::vector<Lanes> matrix(d * (d + 1) / 2);
  const auto [squares, alive] = differentiated(
      points, rows, target, [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
        for (std::size_t k = target.run_in > begin ? target.run_in - begin : 0; k < count; ++k) {
          const Lanes* row = jacobian + k * d;
          std::size_t at = 0;
          for (std::size_t a = 0; a < d; ++a) {
            const Lanes ja = row[a];
            gradient[a] = fma(ja, residual[k], gradient[a]);
            for (std::size_t b = a; b < d; ++b, ++at) {
              matrix[at] = fma(ja, row[b], matrix[at]);
            }
          }
        }
      });
  const auto store = [&](std::size_t slot, const Lanes& value, double factor) {
    for (int lane = 0; lane < lane_count; ++lane) {
      sums[slot * lane_count + static_cast<std::size_t>(lane)] = value.lane(lane) * factor;
    }
  };
  store(0, squares, target.weight);
  store(1, alive, 1.0);
  for (std::size_t a = 0; a < d; ++a) {
    store(2 + a, gradient[a], target.weight);
  }
  for (std::size_t k = 0; k < matrix.size(); ++k) {
    store(2 + d + k, matrix[k], target.weight);
  }
}

// A pack takes as long as its stiffest lane, so candidates are packed in the order of their stiffness. No lane depends
// on its company: the order changes no result.
std::vector<std::size_t> Objective::packing(const std::vector<double>& points) const {
  const std::size_t d = layout_.dimension();
  std::vector<std::size_t> order(points.size() / d);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const CompositeModel& model = layout_.model();
  if (order.size() <= lane_count || model.states() == 0) {
    return order;
  }
  const Target& target = targets_.front();
  double speed = 0.0;
  for (const MotionInterval& interval : target.motion.intervals) {
    speed = std::max(speed, interval.speed);
  }
  std::vector<double> stiffness(order.size());
  std::vector<double> nodes(d);
  std::vector<double> p(model.parameter_count());
  for (std::size_t row = 0; row < order.size(); ++row) {
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = layout_.physical(c, points[row * d + c]);
    }
    parameters_of_pack(layout_, nodes, target.drive, target.frequency, p.data());
    const double bound = stiffness_bound(model, p.data(), speed);
    stiffness[row] = std::isfinite(bound) ? bound : 1e300;
  }
  std::ranges::sort(
      order, [&](std::size_t a, std::size_t b) { return std::tie(stiffness[a], a) < std::tie(stiffness[b], b); });
  return order;
}

void Objective::describe_data(Problem& problem) const {
  problem.recordings.clear();
  for (const Target& target : targets_) {
    problem.recordings.push_back(target.force.size());
  }
  problem.states = static_cast<std::size_t>(layout_.model().states());
}

// In one thread: a window is too short to share.
Response Objective::evaluate_window(const Request& request) const {
  const std::size_t d = layout_.dimension();
  const std::size_t points = request.points.size() / d;
  const auto states = static_cast<std::size_t>(layout_.model().states());
  const Window& window = *request.window;
  const Target& target = targets_[window.recording];
  const std::size_t samples = window.end - window.begin;
  const double scale = std::sqrt(target.weight);
  const double limit = 1e12 * target.normaliser;
  Response response;
  response.cost.resize(points);
  response.residual.resize(points * samples);
  response.states.resize(points * states);
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<Lanes> nodes(d);
  std::vector<Lanes> state(max_states);
  for (std::size_t first = 0; first < points; first += lane_count) {
    const Rows rows = Rows(order).subspan(first, std::min<std::size_t>(lane_count, points - first));
    const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = lanes_of(request.points, rows, layout_, c, false, candidate);
    }
    for (int lane = 0; lane < lane_count && window.begin > 0; ++lane) {
      for (std::size_t s = 0; s < states; ++s) {
        state[s].set_lane(lane, request.states[(first + candidate(static_cast<std::size_t>(lane))) * states + s]);
      }
    }
    march_window<Lanes>(
        layout_.model(), target,
        [&](const auto& drive, Lanes* p) { parameters_of_pack(layout_, nodes, drive, target.frequency, p); },
        window.begin, window.end, state,
        [&](std::size_t begin, std::size_t count, const Lanes* out) {
          check_stopped();
          for (std::size_t lane = 0; lane < rows.size(); ++lane) {
            double* residual = response.residual.data() + (first + lane) * samples + begin - window.begin;
            for (std::size_t k = 0; k < count; ++k) {
              residual[k] = out[k].lane(static_cast<int>(lane)) - target.force[begin + k];
            }
          }
        },
        [](std::size_t, std::size_t, const Lanes*) {});
    for (std::size_t lane = 0; lane < rows.size(); ++lane) {
      double* residual = response.residual.data() + (first + lane) * samples;
      double* end_states = response.states.data() + (first + lane) * states;
      double squares = 0.0;
      bool finite = true;
      for (std::size_t k = 0; k < samples; ++k) {
        finite = finite && std::fabs(residual[k]) < limit;
        residual[k] *= window.begin + k >= target.run_in ? scale : 0.0;
        squares += residual[k] * residual[k];
      }
      for (std::size_t s = 0; s < states; ++s) {
        end_states[s] = state[s].lane(static_cast<int>(lane));
        finite = finite && std::isfinite(end_states[s]);
      }
      response.cost[first + lane] = finite ? std::sqrt(squares) : diverged_cost;
      if (!finite) {
        std::fill_n(residual, samples, 0.0);
        std::fill_n(end_states, states, 0.0);
      }
    }
  }
  return response;
}

Response Objective::evaluate(const Request& request) const {
  if (request.window) {
    return evaluate_window(request);
  }
  const std::size_t d = layout_.dimension();
  const std::size_t points = request.points.size() / d;
  const std::size_t packs = (points + lane_count - 1) / lane_count;
  const std::size_t size = sums_size(d, request.derivatives) * lane_count;
  const std::vector<Target>& targets = request.screening ? screening_targets_ : targets_;
  const std::size_t tasks = packs * targets.size();
  const std::vector<std::size_t> order = packing(request.points);
  std::vector<double> sums(tasks * size);
  parallel_for(tasks, threads_, [&](std::size_t task) {
    const std::size_t first = task / targets.size() * lane_count;
    const Rows rows = Rows(order).subspan(first, std::min<std::size_t>(lane_count, points - first));
    const Target& target = targets[task % targets.size()];
    if (request.derivatives) {
      run_pack<LaneDual>(request.points, rows, target, sums.data() + task * size);
    } else {
      run_pack<Lanes>(request.points, rows, target, sums.data() + task * size);
    }
  });
  double total = 0.0;
  for (const Target& target : targets) {
    total += static_cast<double>(target.force.size() + target.preroll);
  }
  Response response;
  response.cost.resize(points);
  if (request.derivatives) {
    response.gradient.assign(points * d, 0.0);
    response.gauss_newton.assign(points * d * d, 0.0);
  }
  for (std::size_t at = 0; at < points; ++at) {
    const std::size_t row = order[at];
    const std::size_t lane = at % lane_count;
    double squares = 0.0;
    double alive = 0.0;
    const auto sum = [&](std::size_t target, std::size_t slot) {
      return sums[(at / lane_count * targets.size() + target) * size + slot * lane_count + lane];
    };
    for (std::size_t target = 0; target < targets.size(); ++target) {
      squares += sum(target, 0);
      alive += sum(target, 1);
    }
    // A candidate that ran away is worse the earlier it did so.
    const bool finite = alive == total && squares < diverged_cost;
    response.cost[row] = finite ? std::sqrt(squares) : diverged_cost * (2.0 - alive / total);
    if (!request.derivatives || !finite) {
      continue;
    }
    for (std::size_t target = 0; target < targets.size(); ++target) {
      std::size_t slot = 2;
      for (std::size_t a = 0; a < d; ++a) {
        response.gradient[row * d + a] += sum(target, slot++);
      }
      for (std::size_t a = 0; a < d; ++a) {
        for (std::size_t b = a; b < d; ++b) {
          response.gauss_newton[(row * d + a) * d + b] += sum(target, slot++);
        }
      }
    }
    for (std::size_t a = 0; a < d; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        response.gauss_newton[(row * d + a) * d + b] = response.gauss_newton[(row * d + b) * d + a];
      }
    }
  }
  return response;
}

std::vector<Linearised> Objective::linearised(const std::vector<double>& point) const {
  const std::size_t d = layout_.dimension();
  const std::array<std::size_t, 1> row = {0};
  std::vector<Linearised> result(targets_.size());
  parallel_for(targets_.size(), threads_, [&](std::size_t r) {
    const Target& target = targets_[r];
    const double scale = std::sqrt(target.weight);
    result[r].residual.resize(target.force.size());
    result[r].jacobian.resize(target.force.size() * d);
    [[maybe_unused]] const PackSums sums = differentiated(
        point, row, target, [&](std::size_t begin, std::size_t count, const Lanes* jacobian, const Lanes* residual) {
          for (std::size_t n = std::max(begin, target.run_in); n < begin + count; ++n) {
            result[r].residual[n] = scale * residual[n - begin].lane(0);
            for (std::size_t c = 0; c < d; ++c) {
              result[r].jacobian[n * d + c] = scale * jacobian[(n - begin) * d + c].lane(0);
            }
          }
        });
  });
  return result;
}

std::vector<double> predict(const CompositeModel& model, const std::vector<double>& held,
                            const std::vector<Term>& terms, const Target& target) {
  Target motion_only = target;
  motion_only.force.resize(target.motion.time.size());
  std::vector<double> force(motion_only.force.size());
  march_target<double>(
      model, motion_only,
      [&](double drive, double* p) {
        const std::vector<double> values = parameters_at(held, terms, drive, target.frequency);
        std::ranges::copy(values, p);
      },
      [&](std::size_t begin, std::size_t count, const double* out) {
        std::memcpy(force.data() + begin, out, count * sizeof(double));
      },
      [](std::size_t, std::size_t, const double*) {});
  return force;
}

Score score(const std::vector<double>& predicted, const Recording& recording, Normalisation normalisation) {
  double squares = 0.0;
  for (std::size_t n = 0; n < predicted.size(); ++n) {
    const double residual = predicted[n] - recording.force[n];
    squares += residual * residual;
  }
  Score result{};
  result.rmse = std::sqrt(squares / static_cast<double>(predicted.size()));
  result.nrmse = result.rmse / normaliser(recording, normalisation);
  result.fit_percent = 100.0 * (1.0 - result.rmse / standard_deviation(recording.force));
  return result;
}

double overall(const std::vector<Score>& scores, const std::vector<Recording>& recordings, Normalisation normalisation,
               Weighting weighting) {
  double sum = 0.0;
  double total = 0.0;
  double largest = 0.0;
  for (std::size_t r = 0; r < scores.size(); ++r) {
    const auto samples = static_cast<double>(recordings[r].size());
    if (weighting == Weighting::pooled) {
      sum += scores[r].rmse * scores[r].rmse * samples;
      total += samples;
      largest = std::max(largest, normaliser(recordings[r], normalisation));
    } else {
      sum += scores[r].nrmse * scores[r].nrmse;
      total += 1.0;
    }
  }
  return std::sqrt(sum / total) / (weighting == Weighting::pooled ? largest : 1.0);
}

}  // namespace hysteron
