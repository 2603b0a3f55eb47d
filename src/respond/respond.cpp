#include "respond/respond.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace hysteron {
namespace {

constexpr int balance_iterations = 60;
constexpr double balance_tolerance = 1e-13;

// The root of an increasing g by secants kept within the bracket [low, high].
template <class G>
double bracketed_root(const G& g, double low, double high) {
  double g_low = g(low);
  double g_high = g(high);
  for (int k = 0; k < balance_iterations && g_low < 0.0 && g_high > 0.0; ++k) {
    double u = k % 3 == 2 ? 0.5 * (low + high) : low - g_low * (high - low) / (g_high - g_low);
    if (!(u > low && u < high)) {
      u = 0.5 * (low + high);
    }
    const double value = g(u);
    (value < 0.0 ? low : high) = u;
    (value < 0.0 ? g_low : g_high) = value;
    if (value == 0.0 || high - low <= balance_tolerance * std::max(std::fabs(low), std::fabs(high))) {
      break;
    }
  }
  return std::fabs(g_low) < std::fabs(g_high) ? low : high;
}

class System {
 public:
  System(const Oscillator& oscillator, const Excitation& excitation)
      : oscillator_(oscillator), excitation_(excitation) {
    const auto add = [&](const Part& part) {
      links_.push_back({&part, parameters_, states_});
      parameters_ += part.parameters.size();
      states_ += static_cast<std::size_t>(part.states);
    };
    add(*oscillator.model.law);
    for (const Part* effect : oscillator.model.effects) {
      add(*effect);
    }
    conditions_.resize(excitation.conditions.size());
    set_parameters(excitation.time.front());
    probe();
  }

  [[nodiscard]] std::size_t size() const { return 2 + states_; }

  // y: displacement and velocity relative to the base, the model's states. Sets force and acceleration too.
  void rates(double t, const std::vector<double>& y, std::vector<double>& result) {
    if (excitation_.drive || !conditions_.empty()) {
      set_parameters(t);
    }
    Input<double> in{};
    in.x = y[0];
    in.v = y[1];
    in.drive = excitation_.drive ? excitation_.drive->value(t) : 0.0;
    in.time = t - excitation_.time.front();
    in.age = in.time;
    double pull = excitation_.force ? excitation_.force->value(t) : 0.0;
    if (excitation_.base) {
      pull -= oscillator_.mass * excitation_.base->bend(t);
    }
    pull -= oscillator_.damping * y[1] + oscillator_.stiffness * y[0];
    double* own = result.data() + 2;
    force = evaluate(links_.size(), y.data() + 2, in, own);
    acceleration = (pull - force) / oscillator_.mass;
    if (needs_acceleration_) {
      // m a + F(a) = pull: affine in a for a moving mass, so that two secants do.
      double before = 0.0;
      double g_before = force - pull;
      for (int k = 0; k < 8; ++k) {
        in.a = acceleration;
        force = evaluate(links_.size(), y.data() + 2, in, own);
        const double g = oscillator_.mass * acceleration + force - pull;
        const double slope = acceleration == before ? 0.0 : (g - g_before) / (acceleration - before);
        if (std::fabs(g) <= 1e-12 * (std::fabs(pull) + std::fabs(force)) || !(slope > 0.0)) {
          break;
        }
        before = acceleration;
        g_before = g;
        acceleration -= g / slope;
      }
    }
    result[0] = y[1];
    result[1] = acceleration;
  }

  double force = 0.0;
  double acceleration = 0.0;

 private:
  struct Link {
    const Part* part;
    std::size_t parameter;
    std::size_t state;
  };

  void set_parameters(double t) {
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      conditions_[c] = excitation_.conditions[c].value(t);
    }
    constant_ = oscillator_.parameters(excitation_.drive ? excitation_.drive->value(t) : 0.0, conditions_);
  }

  // Force of the links [0, top), and their rates unless null; series elements as in simulate/assembly.hpp.
  double evaluate(std::size_t top, const double* s, const Input<double>& in, double* rates) const {
    if (top == 0) {
      return 0.0;
    }
    const Link& link = links_[top - 1];
    const PartOperations<double>& part = link.part->on_double;
    const double* p = constant_.data() + link.parameter;
    const double* state = s + link.state;
    if (part.yield != nullptr) {
      Yield<double> yield{};
      part.yield(p, *state, yield);
      Input<double> shifted = in;
      shifted.x = in.x - yield.deflection;
      const auto imbalance = [&](double u) {
        Input<double> moved = shifted;
        moved.v = in.v - yield.slope * u;
        return u - yield.gain * (evaluate(top - 1, s, moved, nullptr) - yield.hold * *state);
      };
      const double at_rest = imbalance(0.0);
      const double u =
          at_rest == 0.0 ? 0.0 : bracketed_root(imbalance, std::min(0.0, -at_rest), std::max(0.0, -at_rest));
      if (rates != nullptr) {
        rates[link.state] = u;
      }
      shifted.v = in.v - yield.slope * u;
      return evaluate(top - 1, s, shifted, rates);
    }
    Input<double> seen = in;
    if (part.drive != nullptr) {
      part.drive(p, state, seen);
    }
    double result = evaluate(top - 1, s, seen, rates);
    if (rates != nullptr && link.part->states > 0) {
      if (part.loaded_rate != nullptr) {
        part.loaded_rate(p, state, in, result, rates + link.state);
      } else {
        part.rate(p, state, in, rates + link.state);
      }
    }
    part.force(p, state, in, result);
    return result;
  }

  // What of the motion the force asks for, at a state off every neutral point.
  void probe() {
    const std::vector<double> s(states_ + 1, 0.1);
    Input<double> in{1.1e-3, 0.013, 0.2, 0.1, 0.1, 0.0, 0.0};
    const double plain = evaluate(links_.size(), s.data(), in, nullptr);
    in.jerk = 1e4;
    if (evaluate(links_.size(), s.data(), in, nullptr) != plain) {
      throw InputError(
          "the force depends on the jerk of the motion (sensor-delay), which belongs to a recording's channels and not "
          "to a device; expected a model without it");
    }
    in.jerk = 0.0;
    in.a = 3.7;
    needs_acceleration_ = evaluate(links_.size(), s.data(), in, nullptr) != plain;
  }

  const Oscillator& oscillator_;
  const Excitation& excitation_;
  std::vector<Link> links_;
  std::size_t parameters_ = 0;
  std::size_t states_ = 0;
  bool needs_acceleration_ = false;
  std::vector<double> conditions_;
  std::vector<double> constant_;
};

// Dormand and Prince's coefficients.
constexpr std::array<double, 7> nodes = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};
constexpr double stages[7][6] = {{},
                                 {1.0 / 5.0},
                                 {3.0 / 40.0, 9.0 / 40.0},
                                 {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
                                 {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
                                 {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
                                 {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
constexpr std::array<double, 7> errors = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                                          -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};

// Smallest part of an interval that a step may be.
constexpr double least_part = 1e-9;
constexpr int most_steps = 1000000;  // within an interval
constexpr int steps_between_questions = 1000;

class Integrator {
 public:
  Integrator(System& system, const RespondOptions& options)
      : system_(system), options_(options), y_(system.size(), 0.0), scale_(system.size(), 1e-6), next_(system.size()) {
    y_[0] = options.displacement;
    y_[1] = options.velocity;
    for (auto& k : k_) {
      k.resize(system.size());
    }
    grow();
  }
  [[nodiscard]] const std::vector<double>& state() const { return y_; }

  void advance(double from, double to) {
    if (options_.substeps > 0) {
      const double h = (to - from) / options_.substeps;
      for (int n = 0; n < options_.substeps; ++n) {
        end_if_stopped(from + n * h);
        step(from + n * h, h);
        y_ = next_;
      }
      return;
    }
    double t = from;
    double h = h_ > 0.0 ? std::min(h_, to - from) : 0.01 * (to - from);
    for (int tried = 0; t < to; ++tried) {
      end_if_stopped(t);
      if (tried == most_steps) {
        throw WorkError("the motion cannot be followed at " + std::to_string(t) + " s: " + std::to_string(most_steps) +
                        " steps do not lead from one sample to the next, the equations are too stiff for a motion of " +
                        std::to_string(std::fabs(y_[0])) + " m at " + std::to_string(std::fabs(y_[1])) + " m/s");
      }
      const bool last = t + h >= to * (1.0 - 1e-15) || t + h >= to;
      if (last) {
        h = to - t;
      }
      const double error = step(t, h);
      const double factor = error > 0.0 ? 0.9 * std::pow(error, -0.2) : 5.0;
      if (error <= 1.0) {
        t = last ? to : t + h;
        y_ = next_;
        grow();
        // What is left of an interval says nothing of the step the equations bear.
        const double proposed = h * std::clamp(factor, 0.2, 5.0);
        h_ = last ? std::max(h_, proposed) : proposed;
        h = h_;
        continue;
      }
      h *= std::isfinite(error) ? std::clamp(factor, 0.1, 0.9) : 0.1;
      h_ = h;
      if (!(h > least_part * (to - from))) {
        throw WorkError("the motion cannot be followed at " + std::to_string(t) +
                        " s: it runs away, or the equations are too stiff");
      }
    }
  }

 private:
  void end_if_stopped(double t) {
    if (++steps_ % steps_between_questions == 0 && options_.stopped()) {
      throw WorkError("interrupted at " + std::to_string(t) + " s of the motion; nothing is written");
    }
  }
  void grow() {
    for (std::size_t i = 0; i < y_.size(); ++i) {
      scale_[i] = std::max(scale_[i], std::fabs(y_[i]));
    }
  }
  // Error over the tolerance; NaN where the step left the numbers.
  double step(double t, double h) {
    for (std::size_t stage = 0; stage < 7; ++stage) {
      next_ = y_;
      for (std::size_t i = 0; i < y_.size(); ++i) {
        for (std::size_t j = 0; j < stage; ++j) {
          next_[i] += h * stages[stage][j] * k_[j][i];
        }
      }
      system_.rates(t + nodes[stage] * h, next_, k_[stage]);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      double error = 0.0;
      for (std::size_t stage = 0; stage < 7; ++stage) {
        error += h * errors[stage] * k_[stage][i];
      }
      const double share = std::fabs(error) / (options_.tolerance * std::max(scale_[i], std::fabs(next_[i])));
      worst = share > worst || std::isnan(share) ? share : worst;
      if (!std::isfinite(next_[i])) {
        return std::numeric_limits<double>::quiet_NaN();
      }
    }
    return worst;
  }

  System& system_;
  const RespondOptions& options_;
  std::vector<double> y_;
  std::vector<double> scale_;  // largest size of every state so far
  std::vector<double> next_;
  std::array<std::vector<double>, 7> k_;
  double h_ = 0.0;         // s, the step to try next
  std::size_t steps_ = 0;  // so far
};

}  // namespace

void require_response(const CompositeModel& model, const std::vector<double>& p, bool follows_varying_drive) {
  for (const Part* effect : model.effects) {
    if (follows_varying_drive && (effect->on_double.excite != nullptr || effect->on_double.recall != nullptr)) {
      throw InputError(std::string(effect->id) +
                       " acts on a drive that varies, which is not offered yet; expected a constant drive");
    }
  }
  Oscillator oscillator;
  oscillator.model = model;
  oscillator.parameters = [&](double, std::span<const double>) { return p; };
  Excitation excitation;
  excitation.time = {0.0};
  const System probed(oscillator, excitation);
}

std::vector<Signal> condition_signals(const Recording& recording, bool periodic) {
  std::vector<Signal> result;
  for (const ConditionChannel& condition : recording.conditions) {
    result.emplace_back(
        recording.time,
        condition.values.size() > 1 ? condition.values : std::vector<double>(recording.size(), condition.values[0]),
        Interpolation::linear, periodic);
  }
  return result;
}

MassMotion respond(const Oscillator& oscillator, const Excitation& excitation, const RespondOptions& options) {
  System system(oscillator, excitation);
  Integrator integrator(system, options);
  MassMotion response;
  std::vector<double> rates(system.size());
  for (std::size_t n = 0; n < excitation.time.size(); ++n) {
    if (n > 0) {
      integrator.advance(excitation.time[n - 1], excitation.time[n]);
    }
    const std::vector<double>& y = integrator.state();
    system.rates(excitation.time[n], y, rates);
    response.displacement.push_back(y[0]);
    response.velocity.push_back(y[1]);
    response.acceleration.push_back(system.acceleration);
    response.force.push_back(system.force);
    if (!(std::fabs(y[0]) <= farthest_motion) || !std::isfinite(system.acceleration) || !std::isfinite(system.force)) {
      throw WorkError("the motion runs away at " + std::to_string(excitation.time[n]) + " s");
    }
  }
  return response;
}

}  // namespace hysteron
