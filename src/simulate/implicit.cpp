#include "simulate/implicit.hpp"

#include <algorithm>
#include <numbers>

#include "simulate/balance.hpp"

namespace hysteron {
namespace {

using detail::Relief;
using detail::States;

// g.
constexpr double diagonal = 1.0 - 0.5 * std::numbers::sqrt2;
// Below it a rate is none, in units of the state a second: what differences are taken over when all is at rest.
constexpr double least_rate = 1e-9;
// Steps between two samples that follow hysteresis while it yields: where they are too few it has yielded, and its
// state stays at its bound.
constexpr double most_for_yielding = 2.0;
// Likewise those that follow an element past the knee of its deflection, and how much finer than the rate of q over its
// distance from the knee they are. What they are worth: results/element-steps.md.
constexpr double most_for_a_knee = 8.0;
constexpr double knee_margin = 4.0;
// Of the terms of a residual, what its slope is taken over.
constexpr double least_difference = 1e-6;
// A residual that is flatter has no derivative of its root.
constexpr double least_slope = 1e-3;

// What a link sees over a stage, and, with the speed of the balance, at its end.
enum Instant : std::size_t { at_start, at_middle, at_end, at_balance, instants };
template <class U>
using Path = std::array<Input<U>, instants>;

template <class U>
using Forces = std::array<U, max_links>;

template <class U>
struct Stage {
  using Value = value_t<U>;
  const States<U>* from;       // at its start
  const States<U>* origin;     // of elements: the state less g h times its rate
  const Forces<U>* loads;      // force below each link at its start
  const Stage<Value>* values;  // the same without derivatives; null where there are none
  Value span;                  // s
  Value inverse;               // 1 / span
  Value implicit;              // g h, s
  Value per_implicit;          // 1 / (g h)
};

// At its end.
template <class U>
struct Reached {
  States<U> states;
  Forces<U> loads;
};

// First guess of an element's rate, and the slope of its residual: at least 1, or 0 where it is not known.
template <class V>
struct Guess {
  V rate;
  V slope;
};

// a + slope (b - b.v): the derivatives of b by way of a slope.
template <class T>
[[gnu::always_inline]] inline T by_way_of(const T& a, const value_t<T>& slope, const T& b) {
  T result = a;
  repeat<T::directions>([&](auto i) __attribute__((always_inline)) { result.d[i] = fma(slope, b.d[i], a.d[i]); });
  return result;
}

template <class T>
class Implicit : public detail::Balance<T> {
 public:
  using Balance = detail::Balance<T>;
  using Value = typename Balance::Value;

  Implicit(const CompositeModel& model, const Motion& motion) : Balance(model, motion) {
    relief_.factor.fill(Value(1.0));
    relief_.resistance.fill(Value(0.0));
    relief_.speed.fill(Value(0.0));
  }

  // Force at an instant, with the force below each link.
  T force(const States<T>& s, const Input<T>& in, Forces<T>& loads) {
    return Balance::evaluate(links_.size(), p_, s.data(), in, relief_, rates_.data(), loads.data());
  }

  // Looks at an instant before a step: the rates there, of which the stages take their first guesses, and the bound in
  // 1/s that steps follow; `per_step` of it asks for a step between two samples.
  Value look(const States<Value>& s, const Input<Value>& at, double speed, double per_step) {
    Balance::template evaluate<Value>(links_.size(), values_.data(), s.data(), at, relief_, before_.data());
    Value result(0.0);
    Input<Value> in = at;
    for (std::size_t i = links_.size(); i-- > 0;) {
      const auto& link = links_[i];
      const Value* own = values_.data() + link.parameter;
      const Value* state = s.data() + link.state;
      if (link.values->yield != nullptr) {
        Yield<Value> yield;
        link.values->yield(own, *state, yield);
        const Value& u = before_[static_cast<std::size_t>(link.state)];
        guesses_[i] = {u, Value(0.0)};
        in.x = in.x - yield.deflection;
        in.v = in.v - yield.slope * u;
        const auto bent = yield.width > Value(0.0);
        const Value span = select(bent, abs(*state) + yield.width, Value(1.0));
        const Value passing = min(Value(knee_margin) * abs(u) / span, Value(most_for_a_knee * per_step));
        result = result + select(bent, passing, Value(0.0));
        continue;
      }
      if (link.states > 0 && link.values->stiffness != nullptr) {
        const Value bound = Balance::bounds_of(i, in.v, speed, before_.data()).at_rest;
        const Value others = link.values->settles < 0 ? bound : this->slack_[i];
        result = result + others + min(bound - others, Value(most_for_yielding * per_step));
      }
      if (link.values->drive != nullptr) {
        link.values->drive(own, state, in);
      }
    }
    return result;
  }

  // The stage from `from`; inputs as recorded.
  template <class At>
  void stage(const At& at, const Value& theta, const Value& to, const Value& h, const Value& span,
             const States<T>& from, const States<T>& origin, const Forces<T>& loads, Reached<T>& reached) {
    Path<T> path{at(theta), at(fma(Value(0.5), to - theta, theta)), at(to), at(to)};
    const Value implicit = Value(diagonal) * h;
    Stage<T> stage{&from, &origin, &loads, nullptr, span, Value(1.0) / span, implicit, Value(1.0) / implicit};
    Stage<Value> values;
    if constexpr (Balance::differentiates) {
      copy_values(from, value_from_);
      copy_values(origin, value_origin_);
      for (std::size_t i = 0; i < links_.size(); ++i) {
        value_loads_[i] = value_of(loads[i]);
      }
      values = {&value_from_, &value_origin_, &value_loads_,  nullptr,
                stage.span,   stage.inverse,  stage.implicit, stage.per_implicit};
      stage.values = &values;
    }
    advance(links_.size(), p_, path, stage, reached);
  }

  void copy_values(const States<T>& from, States<Value>& to) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(states_); ++i) {
      to[i] = value_of(from[i]);
    }
  }

 private:
  using Balance::links_;
  using Balance::motion_;
  using Balance::p_;
  using Balance::states_;
  using Balance::values_;

  // Force of the links [0, top) at the end of a stage, their states there and the force below each. Elements shift
  // the path for those below and put it back.
  template <class U>
  U advance(std::size_t top, const U* p, Path<U>& path, const Stage<U>& stage, Reached<U>& reached) {
    if (top == 0) {
      return U(0.0);
    }
    const auto& link = links_[top - 1];
    if (link.values->yield != nullptr) {
      return element(top - 1, p, path, stage, reached);
    }
    const PartOperations<U>& part = Balance::template operations<U>(link);
    const U* own = p + link.parameter;
    const auto first = static_cast<std::size_t>(link.state);
    const U* from = stage.from->data() + first;
    U* to = reached.states.data() + first;
    const bool loaded = part.loaded_rate != nullptr;
    if (link.states > 0 && !loaded) {
      const auto rate = [&](const U* s, const Input<U>& in, double /*along*/, U* rates) __attribute__((always_inline)) {
        part.rate(own, s, in, rates);
        if (part.settles >= 0) part.rest(own, s, in, rates);
      };
      step(link.states, part.settles, stage, from, to, path, rate);
    }
    U force(0.0);
    if (part.drive != nullptr) {
      Path<U> driven = path;
      std::array<U, most_states_of_a_link> middle;
      for (std::size_t i = 0; i < static_cast<std::size_t>(link.states); ++i) {
        middle[i] = U(0.5) * (from[i] + to[i]);
      }
      part.drive(own, from, driven[at_start]);
      part.drive(own, middle.data(), driven[at_middle]);
      part.drive(own, to, driven[at_end]);
      part.drive(own, to, driven[at_balance]);
      force = advance(top - 1, p, driven, stage, reached);
    } else {
      force = advance(top - 1, p, path, stage, reached);
    }
    reached.loads[top - 1] = force;
    if (loaded) {
      const U before = (*stage.loads)[top - 1];
      const auto rate = [&](const U* s, const Input<U>& in, double along, U* rates) __attribute__((always_inline)) {
        part.loaded_rate(own, s, in, before + U(along) * (force - before), rates);
      };
      step(link.states, -1, stage, from, to, path, rate);
    }
    part.force(own, to, path[at_balance], force);
    return force;
  }

  // A step of one link's states over a stage; rate(state, input, part of the stage passed, rates). The state that 1
  // bounds stays within: where it is followed too coarsely it has yielded.
  template <class U, class Rate>
  void step(int states, int settles, const Stage<U>& stage, const U* from, U* to, const Path<U>& path,
            const Rate& rate) {
    std::array<U, most_states_of_a_link> k1;
    std::array<U, most_states_of_a_link> k;
    std::array<U, most_states_of_a_link> sum;
    std::array<U, most_states_of_a_link> trial;
    const auto n = static_cast<std::size_t>(states);
    const Value half = Value(0.5) * stage.span;
    const Value sixth = Value(1.0 / 6.0) * stage.span;
    const auto bounded = [&](U * s) __attribute__((always_inline)) {
      if (settles >= 0) s[settles] = max(min(s[settles], U(1.0)), U(-1.0));
    };
    rate(from, path[at_start], 0.0, k1.data());
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] = k1[i];
      trial[i] = detail::scaled_sum(half, k1[i], from[i]);
    }
    bounded(trial.data());
    rate(trial.data(), path[at_middle], 0.5, k.data());
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] = detail::scaled_sum(Value(2.0), k[i], sum[i]);
      trial[i] = detail::scaled_sum(half, k[i], from[i]);
    }
    bounded(trial.data());
    rate(trial.data(), path[at_middle], 0.5, k.data());
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] = detail::scaled_sum(Value(2.0), k[i], sum[i]);
      trial[i] = detail::scaled_sum(stage.span, k[i], from[i]);
    }
    bounded(trial.data());
    rate(trial.data(), path[at_end], 1.0, k.data());
    for (std::size_t i = 0; i < n; ++i) {
      to[i] = detail::scaled_sum(sixth, sum[i] + k[i], from[i]);
    }
    bounded(to);
  }

  // An element over a stage at a trial rate, with what is below it.
  template <class U>
  struct Trial {
    U force;
    U residual;
    Value tolerance;  // of the residual
  };
  // The element above the links [0, top), before its rate is known.
  template <class U>
  struct Element {
    const PartOperations<U>* part;
    const U* own;
    std::size_t state;
    U origin;
    Yield<U> start;             // at the start of the stage
    Yield<U> at_origin;         // where it comes from
    std::array<U, instants> x;  // of the path, before it is shifted
    std::array<U, instants> v;
  };

  template <class U>
  Element<U> element_of(std::size_t top, const U* p, const Path<U>& path, const Stage<U>& stage) const {
    const auto& link = links_[top];
    Element<U> result;
    result.part = &Balance::template operations<U>(link);
    result.own = p + link.parameter;
    result.state = static_cast<std::size_t>(link.state);
    result.origin = (*stage.origin)[result.state];
    result.part->yield(result.own, (*stage.from)[result.state], result.start);
    result.part->yield(result.own, result.origin, result.at_origin);
    for (std::size_t k = 0; k < instants; ++k) {
      result.x[k] = path[k].x;
      result.v[k] = path[k].v;
    }
    return result;
  }

  template <class U>
  Trial<U> at_rate(const Element<U>& element, const Value& u, std::size_t top, const U* p, Path<U>& path,
                   const Stage<U>& stage, Reached<U>& reached) {
    const U q = detail::scaled_sum(stage.implicit, U(u), element.origin);
    reached.states[element.state] = q;
    Yield<U> yield;
    element.part->yield(element.own, q, yield);
    const U moved = yield.deflection - element.start.deflection;
    const U speed = detail::scaled_sum(stage.inverse, moved, U(0.0));
    const U last = detail::scaled_sum(stage.per_implicit, yield.deflection - element.at_origin.deflection, U(0.0));
    const std::array<U, instants> taken = {element.start.deflection,
                                           detail::scaled_sum(Value(0.5), moved, element.start.deflection),
                                           yield.deflection, yield.deflection};
    const std::array<U, instants> speeds = {speed, speed, speed, last};
    for (std::size_t k = 0; k < instants; ++k) {
      path[k].x = element.x[k] - taken[k];
      path[k].v = element.v[k] - speeds[k];
    }
    Trial<U> result;
    result.force = advance(top, p, path, stage, reached);
    const U held = yield.hold * q;
    result.residual = U(u) - yield.gain * (result.force - held);
    const Value terms =
        abs(u) + value_of(yield.gain) * (abs(value_of(result.force)) + abs(value_of(held))) + Value(least_rate);
    result.tolerance = Value(motion_.balance_tolerance) * terms;
    return result;
  }

  template <class U>
  static void put_back(const Element<U>& element, Path<U>& path) {
    for (std::size_t k = 0; k < instants; ++k) {
      path[k].x = element.x[k];
      path[k].v = element.v[k];
    }
  }

  // Force of the links [0, top) below an element, at the rate that balances it.
  template <class U>
  U element(std::size_t top, const U* p, Path<U>& path, const Stage<U>& stage, Reached<U>& reached) {
    if constexpr (std::is_same_v<U, Value>) {
      const Element<U> here = element_of(top, p, path, stage);
      const U force = balanced(here, top, p, path, stage, reached).force;
      put_back(here, path);
      return force;
    } else {
      return differentiated(top, p, path, stage, reached);
    }
  }

  struct Balanced {
    Value u;
    Value force;
    typename detail::Secants<Value>::Residual residual;
  };

  // From the first guess, whose rate is then that of the root.
  Balanced balanced(const Element<Value>& here, std::size_t top, const Value* p, Path<Value>& path,
                    const Stage<Value>& stage, Reached<Value>& reached) {
    Value force;
    const auto residual = [&](const Value& u) -> typename detail::Secants<Value>::Residual {
      const Trial<Value> trial = at_rate(here, u, top, p, path, stage, reached);
      force = trial.force;
      return {trial.residual, trial.tolerance};
    };
    Guess<Value>& guess = guesses_[top];
    const Value before = guess.rate;
    const auto first = residual(before);
    const auto off = abs(first.g) > first.tolerance;
    if (!any(off)) {
      return {before, force, first};
    }
    const Value least = fma(stage.implicit * here.start.gain, here.start.hold, Value(1.0));
    const Value slope = select(guess.slope > Value(1.0), guess.slope, least);
    const Value u = select(off, before - first.g / slope, before);
    const auto second = residual(u);
    const auto differs = abs(u - before) > Value(0.0);
    const Value secant = (second.g - first.g) / select(differs, u - before, Value(1.0));
    guess.slope = select(differs & (secant > Value(1.0)), secant, guess.slope);
    detail::Secants<Value> secants(before, first.g);
    secants.take(u, second);
    secants.close_in(motion_.balance_iterations, residual);
    guess.rate = secants.u();
    return {secants.u(), force, secants.residual()};
  }

  // The root of the values, and its derivatives by the implicit function theorem: the slopes with u are differences.
  T differentiated(std::size_t top, const T* p, Path<T>& path, const Stage<T>& stage, Reached<T>& reached) {
    Path<Value> values;
    std::ranges::transform(path, values.begin(), Balance::value_input);
    const Element<Value> here = element_of(top, values_.data(), values, *stage.values);
    Reached<Value>& at = room_[2 * top];
    Reached<Value>& beside = room_[2 * top + 1];
    const Balanced root = balanced(here, top, values_.data(), values, *stage.values, at);
    const auto guesses = guesses_;  // what follows is none of the march's own course
    const Value aside = fma(Value(least_difference / motion_.balance_tolerance), root.residual.tolerance, root.u);
    const Trial<Value> trial = at_rate(here, aside, top, values_.data(), values, *stage.values, beside);
    const Value inverse = Value(1.0) / (aside - root.u);
    const Element<T> element = element_of(top, p, path, stage);
    const Trial<T> known = at_rate(element, root.u, top, p, path, stage, reached);
    put_back(element, path);
    guesses_ = guesses;
    const Value slope = (trial.residual - root.residual.g) * inverse;
    const T u = chain(known.residual, root.u, Value(-1.0) / select(abs(slope) > Value(least_slope), slope, Value(1.0)));
    for (std::size_t i = 0; i < element.state; ++i) {
      reached.states[i] = by_way_of(reached.states[i], (beside.states[i] - at.states[i]) * inverse, u);
    }
    for (std::size_t i = 0; i < top; ++i) {
      if (links_[i].values->yield == nullptr) {
        reached.loads[i] = by_way_of(reached.loads[i], (beside.loads[i] - at.loads[i]) * inverse, u);
      }
    }
    reached.states[element.state] = by_way_of(reached.states[element.state], stage.implicit, u);
    return by_way_of(known.force, (trial.force - root.force) * inverse, u);
  }

  Relief<Value> relief_;
  std::array<Guess<Value>, max_links> guesses_;
  States<T> rates_;
  States<Value> before_;
  States<Value> value_from_;
  States<Value> value_origin_;
  Forces<Value> value_loads_;
  std::array<Reached<Value>, 2 * max_links> room_;
};

// Room for the steps, made once.
template <class T>
struct Room {
  States<T> state;
  States<value_t<T>> values;
  States<T> origin;
  Forces<T> loads;
  Reached<T> first;
  Reached<T> second;
};

// Over the part [from, to] of interval n.
template <class T>
void march_segment(Implicit<T>& system, const Motion& motion, std::size_t n, double from, double to, Room<T>& room) {
  using Value = value_t<T>;
  const MotionInterval& interval = motion.intervals[n];
  const MotionCourse& course = course_from(motion, interval, from);
  const double finer = detail::fineness(motion, n);
  const double limit = motion.step_limit / interval.length;
  const Value shortest((to - from) / motion.most_substeps);
  const auto states = static_cast<std::size_t>(system.states());
  const auto at = [&](const Value& theta) { return detail::input_at<T>(motion, n, course, theta); };
  Value theta(from);
  auto active = theta < Value(to);
  while (any(active)) {
    system.copy_values(room.state, room.values);
    const Value stiffness =
        system.look(room.values, detail::input_at<Value>(motion, n, course, theta), interval.speed, limit);
    const Value left = Value(to) - theta;
    Value step = Value(limit) / max(Value(finer) * stiffness, Value(1e-300));
    step = select(step < shortest, shortest, step);
    step = select(step < left, step, left);  // all that is left for a lane with NaN
    const Value reached = select(step < left * Value(1.0 - 1e-9), theta + step, Value(to));
    step = select(step > Value(0.0), step, shortest);  // of a lane that is done
    const Value h = step * Value(interval.length);
    const Value between = fma(Value(diagonal), step, theta);
    system.stage(at, theta, between, h, Value(diagonal) * h, room.state, room.state, room.loads, room.first);
    for (std::size_t i = 0; i < states; ++i) {
      const T advanced = room.first.states[i] - room.state[i];
      room.origin[i] = detail::scaled_sum(Value((1.0 - diagonal) / diagonal), advanced, room.state[i]);
    }
    system.stage(at, between, reached, h, Value(1.0 - diagonal) * h, room.first.states, room.origin, room.first.loads,
                 room.second);
    for (std::size_t i = 0; i < states; ++i) {
      room.state[i] = select(active, room.second.states[i], room.state[i]);
    }
    for (std::size_t i = 0; i < max_links; ++i) {
      room.loads[i] = select(active, room.second.loads[i], room.loads[i]);
    }
    theta = select(active, reached, theta);
    active = theta < Value(to);
  }
}

}  // namespace

bool takes_implicit_steps(const CompositeModel& model) {
  return std::ranges::any_of(model.effects, [](const Part* effect) { return effect->in_series(); }) &&
         model.law->states <= most_states_of_a_link &&
         std::ranges::all_of(model.effects, [](const Part* effect) { return effect->states <= most_states_of_a_link; });
}

template <class T>
void march_implicit(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                    std::size_t begin, std::size_t end, T* state, T* out) {
  Implicit<T> system(model, motion);
  Room<T> room;
  std::copy_n(state, system.states(), room.state.begin());
  std::vector<T> between(stride);
  for (std::size_t n = begin; n < end; ++n) {
    if (n == begin || stride > 0) {
      system.set_parameters(p + (n - begin) * stride);
    }
    out[n - begin] = system.force(room.state, detail::input_of_sample<T>(motion, n), room.loads);
    if (n >= motion.intervals.size()) {
      continue;
    }
    if (stride > 0) {
      detail::parameters_between(p + (n - begin) * stride, stride, between.data());
      system.set_parameters(between.data());
    }
    detail::in_parts(motion.intervals[n],
                     [&](double from, double to) { march_segment<T>(system, motion, n, from, to, room); });
  }
  std::copy_n(room.state.begin(), system.states(), state);
}

template void march_implicit<double>(const CompositeModel&, const Motion&, const double*, std::size_t, std::size_t,
                                     std::size_t, double*, double*);
template void march_implicit<Lanes>(const CompositeModel&, const Motion&, const Lanes*, std::size_t, std::size_t,
                                    std::size_t, Lanes*, Lanes*);
template void march_implicit<LaneDual>(const CompositeModel&, const Motion&, const LaneDual*, std::size_t, std::size_t,
                                       std::size_t, LaneDual*, LaneDual*);

}  // namespace hysteron
