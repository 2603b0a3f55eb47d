#include "simulate/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/balance.hpp"

namespace hysteron {
namespace {

using detail::Relief;
using detail::States;

// How much finer than their rate the steps of elements are: their knees are passed with a step on either side.
constexpr double element_margin = 1.25;
// Steps are this part of an interval at least: a shorter one at its end would be lost in rounding, and a step that gets
// nowhere is repeated for ever. A reversal may lie that close to a sample.
constexpr double least_progress = 1e-15;

template <class T>
class Assembly : public detail::Balance<T> {
 public:
  using Balance = detail::Balance<T>;
  using Value = typename Balance::Value;
  using Balance::Balance;

  // Force at the start of a step, its rates, the bounds of their stiffness and the relief to step with.
  struct Start {
    T force;
    States<T> rates;
    Value elements;   // stiffness of the series elements, 1/s
    Value stiffness;  // of all other links
    Value at_rest;    // likewise without states that rest at their bounds
    Relief<Value> relief;
  };
  // `speed` and `acceleration` bound those of the recorded motion over the interval. The relief of the step before is
  // taken as the first guess.
  void start(const States<T>& s, const Input<T>& in, double speed, double acceleration, Start& result) const {
    result.relief.factor.fill(Value(1.0));
    result.force = evaluate(links_.size(), p_, s.data(), in, result.relief, result.rates.data());
    States<Value> state;
    States<Value> rates;
    for (int i = 0; i < states_; ++i) {
      state[static_cast<std::size_t>(i)] = value_of(s[static_cast<std::size_t>(i)]);
      rates[static_cast<std::size_t>(i)] = value_of(result.rates[static_cast<std::size_t>(i)]);
    }
    survey(state.data(), value_input(in), rates.data(), speed, acceleration, result);
    // Lanes that are not slowed keep their bits whether or not a neighbour is.
    auto slowed = result.relief.factor[0] < Value(1.0);
    for (std::size_t i = 1; i < links_.size(); ++i) {
      slowed = slowed | (result.relief.factor[i] < Value(1.0));
    }
    if (any(slowed)) {
      States<T> rates_slowed;
      const T force = evaluate(links_.size(), p_, s.data(), in, result.relief, rates_slowed.data());
      result.force = select(slowed, force, result.force);
      for (std::size_t i = 0; i < static_cast<std::size_t>(states_); ++i) {
        result.rates[i] = select(slowed, rates_slowed[i], result.rates[i]);
      }
    }
  }

  void rate(const States<T>& s, const Input<T>& in, const Relief<Value>& relief, States<T>& rates) const {
    evaluate(links_.size(), p_, s.data(), in, relief, rates.data());
  }

  // Lanes in which a state that rested at its bound in `before` moves on by more than `little` a second in `now`.
  [[nodiscard]] auto woken(const States<T>& before, const States<T>& now, const Value& little) const {
    auto result = little < Value(0.0);
    for (const Link& link : links_) {
      if (link.operations->settles < 0) continue;
      const auto k = static_cast<std::size_t>(link.state) + static_cast<std::size_t>(link.operations->settles);
      result = result | (detail::rests(value_of(before[k])) & (abs(value_of(now[k])) > little));
    }
    return result;
  }

 private:
  using Balance::damping;
  using Balance::evaluate;
  using Balance::links_;
  using Balance::motion_;
  using Balance::p_;
  using Balance::states_;
  using Balance::value_input;
  using Balance::values_;
  using typename Balance::Link;

  // Bounds of the stiffness of all rates at a state with known rates; sets the relief that keeps every element within
  // motion.element_rate_limit. A link is taken to move at least as fast as the recording does.
  void survey(const Value* s, Input<Value> in, const Value* rates, double speed, double acceleration,
              Start& result) const {
    result.elements = Value(0.0);
    result.stiffness = Value(0.0);
    result.at_rest = Value(0.0);
    Relief<Value>& relief = result.relief;
    const Value* p = values_.data();
    for (std::size_t i = links_.size(); i-- > 0;) {
      const Link& link = links_[i];
      const Value* state = s + link.state;
      if (link.values->yield != nullptr) {
        Yield<Value> yield;
        link.values->yield(p + link.parameter, *state, yield);
        const Value& u = rates[link.state];
        in = {in.x - yield.deflection, in.v - yield.slope * u, in.drive, in.time, in.age, in.a, in.jerk};
        relief.speed[i] = in.v;
        const Value stiffness = instantaneous_stiffness(i, s, in, speed, relief);
        const Value resistance = relief.resistance[i];
        const Value gain = yield.gain / fma(yield.gain * yield.slope, resistance, Value(1.0));
        const Value lambda = gain * (yield.hold + yield.slope * stiffness);
        relief.factor[i] =
            select(lambda > Value(motion_.element_rate_limit), Value(motion_.element_rate_limit) / lambda, Value(1.0));
        // The step must not pass over the knee of the deflection, be it on the way now or about to be pushed there by
        // the motion: u' = push.
        const auto bent = yield.width > Value(0.0);
        const Value span = select(bent, abs(*state) + yield.width, Value(1.0));
        const Value push = gain * (resistance * Value(acceleration) + stiffness * (abs(in.v) + Value(speed)));
        const Value passing = select(bent, abs(u) / span + sqrt(push / span), Value(0.0));
        const Value bending = gain * abs(yield.bend * u) * resistance;
        result.elements = result.elements + min(lambda, Value(motion_.element_rate_limit)) + passing + bending;
        continue;
      }
      if (link.states > 0 && link.values->stiffness != nullptr) {
        const auto bounds = this->bounds_of(i, in.v, speed, rates);
        result.stiffness = result.stiffness + bounds.whole;
        result.at_rest = result.at_rest + bounds.at_rest;
      }
      if (link.values->drive != nullptr) {
        link.values->drive(p + link.parameter, state, in);
      }
    }
  }

  // K of the links [0, top); sets their resistance.
  Value instantaneous_stiffness(std::size_t top, const Value* s, const Input<Value>& in, double speed,
                                Relief<Value>& relief) const {
    const Value* p = values_.data();
    const int below = links_[top].state;
    relief.resistance[top] = max(damping(top, p, s, in, relief), Value(0.0));
    Value stiffness(0.0);
    const Value fast = abs(in.v) + Value(0.01 * speed + 1e-9);
    constexpr double moment = 1e-7;  // s
    States<Value> rest;
    States<Value> rates;
    States<Value> shifted;
    Input<Value> probe = in;
    probe.v = Value(0.0);
    Balance::template evaluate<Value>(top, p, s, probe, relief, rest.data());
    const Value force = Balance::template evaluate<Value>(top, p, s, in, relief, nullptr);
    for (const double direction : {1.0, -1.0}) {
      probe.v = Value(direction) * fast;
      Balance::template evaluate<Value>(top, p, s, probe, relief, rates.data());
      for (std::size_t i = 0; i < static_cast<std::size_t>(below); ++i) {
        shifted[i] = s[i] + Value(moment) * (rates[i] - rest[i]);
      }
      Input<Value> after = in;
      after.x = in.x + Value(moment) * probe.v;
      const Value rise = Balance::template evaluate<Value>(top, p, shifted.data(), after, relief, nullptr) - force;
      stiffness = max(stiffness, abs(rise / (Value(moment) * fast)));
    }
    return stiffness;
  }
};

// Room for one step, made once: clearing it would cost as much as the step.
template <class T>
struct Room {
  typename Assembly<T>::Start start{};
  detail::Stages<T, -1> stages;
  States<T> next;
};

double acceleration_along(const MotionCourse& course, double length) {
  return detail::change_of_velocity(course) / length;
}

// Bounds of the motion behind a sample.
struct Pace {
  double speed;         // m/s
  double acceleration;  // m/s^2
};

Pace pace_of(const Motion& motion, std::size_t n) {
  if (n >= motion.intervals.size()) return {0.0, 0.0};
  const MotionInterval& interval = motion.intervals[n];
  return {interval.speed, acceleration_along(interval.course, interval.length)};
}

// Where the motion goes on as at the sample, for as long as the interval before it.
Pace pace_expected(const Motion& motion, std::size_t n) {
  const double h = n > 0 ? motion.intervals[n - 1].length : 0.0;
  const double slope = velocity_slope(motion, n);
  return {std::max(std::fabs(motion.v[n]), std::fabs(motion.v[n] + h * slope)) + 8.0 / 27.0 * h * std::fabs(slope),
          std::fabs(slope)};
}

// Over the part [from, to] of interval n; `start` belongs to `from` when `known`.
template <class T>
void march_segment(const Assembly<T>& system, const Motion& motion, std::size_t n, double from, double to, bool known,
                   Room<T>& room, States<T>& state) {
  using Value = value_t<T>;
  const MotionInterval& interval = motion.intervals[n];
  const MotionCourse& course = course_from(motion, interval, from);
  // The kinks are those of the laws: elements are smooth on the scale that their own stiffness tells.
  const double finer = detail::fineness(motion, n);
  const double limit = motion.step_limit / interval.length;
  const Value shortest(std::max((to - from) / motion.most_substeps, least_progress));
  const Value little(1e-9 / (interval.length * (to - from)));
  Value theta(from);
  auto& start = room.start;
  auto active = theta < Value(to);
  auto careful = theta < Value(0.0);  // lanes in which a state woke up within a step over which it was to rest
  while (any(active)) {
    const Input<T> in = detail::input_at<T>(motion, n, course, theta);
    if (!known) {
      const auto before = start.relief;
      system.start(state, in, interval.speed, acceleration_along(course, interval.length), start);
      for (std::size_t i = 0; i < max_links; ++i) {
        start.relief.speed[i] = select(active, start.relief.speed[i], before.speed[i]);
        start.relief.resistance[i] = select(active, start.relief.resistance[i], before.resistance[i]);
      }
    }
    known = false;
    const Value left = Value(to) - theta;
    const Value stiffness = select(careful, start.stiffness, start.at_rest);
    Value step = Value(limit) / fma(Value(finer), stiffness, Value(element_margin) * start.elements);
    step = select(step < shortest, shortest, step);
    step = select(step < left, step, left);  // all that is left for a lane with NaN
    const Value reached = select(step < left * Value(1.0 - 1e-9), theta + step, Value(to));
    const Value middle = fma(Value(0.5), step, theta);
    const auto rate = [&](const States<T>& s, const Input<T>& at, States<T>& rates) {
      system.rate(s, at, start.relief, rates);
    };
    detail::advance<-1, T>(rate, system.states(), step * Value(interval.length), start.rates,
                           detail::input_at<T>(motion, n, course, middle),
                           detail::input_at<T>(motion, n, course, reached), state, room.stages, room.next);
    const auto awake = (stiffness < start.stiffness) & (system.woken(start.rates, room.stages.k2, little) |
                                                        system.woken(start.rates, room.stages.k3, little) |
                                                        system.woken(start.rates, room.stages.k4, little));
    for (std::size_t i = 0; i < static_cast<std::size_t>(system.states()); ++i) {
      state[i] = select(active, select(awake, state[i], room.next[i]), state[i]);
    }
    theta = select(active, select(awake, theta, reached), theta);
    careful = careful | (active & awake);
    active = theta < Value(to);
  }
}

}  // namespace

template <class T>
void march_assembly(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                    std::size_t begin, std::size_t end, T* state, T* out) {
  Assembly<T> system(model, motion);
  States<T> current;
  std::copy_n(state, system.states(), current.begin());
  Room<T> room;
  auto& start = room.start;
  std::vector<T> between(stride);
  for (std::size_t n = begin; n < end; ++n) {
    if (n == begin || stride > 0) {
      system.set_parameters(p + (n - begin) * stride);
    }
    const bool last = n >= motion.intervals.size();
    const auto start_at = [&](const Pace& pace) {
      // No guess from the interval before: a march in pieces gives the bits of one in a single piece.
      start.relief.speed.fill(value_t<T>(0.0));
      start.relief.resistance.fill(value_t<T>(0.0));
      system.start(current, detail::input_of_sample<T>(motion, n), pace.speed, pace.acceleration, start);
    };
    start_at(motion.foresight ? pace_of(motion, n) : pace_expected(motion, n));
    out[n - begin] = start.force;
    if (last) {
      continue;
    }
    if (!motion.foresight) start_at(pace_of(motion, n));
    const MotionInterval& interval = motion.intervals[n];
    if (stride > 0) {
      detail::parameters_between(p + (n - begin) * stride, stride, between.data());
      system.set_parameters(between.data());
    }
    bool known = motion.foresight && stride == 0 && interval.corner < 0;
    detail::in_parts(interval, [&](double from, double to) {
      march_segment<T>(system, motion, n, from, to, known, room, current);
      known = false;
    });
  }
  std::copy_n(current.begin(), system.states(), state);
}

template void march_assembly<double>(const CompositeModel&, const Motion&, const double*, std::size_t, std::size_t,
                                     std::size_t, double*, double*);
template void march_assembly<Lanes>(const CompositeModel&, const Motion&, const Lanes*, std::size_t, std::size_t,
                                    std::size_t, Lanes*, Lanes*);
template void march_assembly<LaneDual>(const CompositeModel&, const Motion&, const LaneDual*, std::size_t, std::size_t,
                                       std::size_t, LaneDual*, LaneDual*);

}  // namespace hysteron
