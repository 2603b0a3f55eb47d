// The balance of forces at an instant in a chain with series elements, or with states that are driven by the force.
//
// A series element (Yield, part.hpp) with state q deflects by D(q), and the links below see x - D, v - D' u with u =
// q'. u solves
//   g(u) = u - gain (F_below(x - D, v - D' u) - hold q) = 0,
// which has g' = 1 + gain D' dF/dv >= 1 for every law whose force does not fall with velocity: one root, between 0 and
// -g(0). The derivatives of u follow from the implicit function theorem.
#pragma once

#include <array>
#include <vector>

#include "simulate/composite.hpp"
#include "simulate/march.hpp"
#include "simulate/part.hpp"
#include "simulate/secants.hpp"

namespace hysteron::detail {

// What a step holds of its series links: a factor on the gain, and, for the root's first guess, dF/dv of the links
// below and the speed they moved at when the step began.
template <class V>
struct Relief {
  std::array<V, max_links> factor;
  std::array<V, max_links> resistance;
  std::array<V, max_links> speed;
};
template <class T>
using States = std::array<T, static_cast<std::size_t>(max_states)>;

template <class V>
struct Root {
  V u;
  V force;  // of the links below, at u
};

template <class T>
class Balance {
 public:
  using Value = value_t<T>;
  static constexpr bool differentiates = !std::is_same_v<T, Value>;

  Balance(const CompositeModel& model, const Motion& motion)
      : motion_(motion), parameters_(model.parameter_count()), states_(model.states()) {
    model.for_links([this](const hysteron::Link& link) {
      const Part& part = *link.part;
      links_.push_back({&part.on<T>(), &part.on<Value>(), link.parameter, link.state, part.states});
    });
    values_.resize(parameters_);
    still_.resize(links_.size());
    slack_.resize(links_.size());
  }

  [[nodiscard]] int states() const { return states_; }

  void set_parameters(const T* p) {
    p_ = p;
    for (std::size_t j = 0; j < parameters_; ++j) {
      values_[j] = value_of(p[j]);
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      if (link.values->stiffness != nullptr) {
        still_[i] = link.values->stiffness(values_.data() + link.parameter, 0.0);
        if (link.values->settles >= 0) slack_[i] = link.values->slack(values_.data() + link.parameter);
      }
    }
  }

 protected:
  struct Link {
    const PartOperations<T>* operations;
    const PartOperations<Value>* values;
    std::size_t parameter;
    int state;
    int states;
  };

  static Input<Value> value_input(const Input<T>& in) {
    return {value_of(in.x),   value_of(in.v), value_of(in.drive), value_of(in.time),
            value_of(in.age), value_of(in.a), value_of(in.jerk)};
  }
  template <class U>
  static const PartOperations<U>& operations(const Link& link) {
    if constexpr (std::is_same_v<U, T>) {
      return *link.operations;
    } else {
      return *link.values;
    }
  }

  // Force of the links [0, top) under `in`, and, unless null, their rates and the force below each of them.
  template <class U>
  U evaluate(std::size_t top, const U* p, const U* s, const Input<U>& in, const Relief<Value>& relief, U* rates,
             U* forces_below = nullptr) const {
    if (top == 0) {
      return U(0.0);
    }
    const Link& link = links_[top - 1];
    const PartOperations<U>& part = operations<U>(link);
    const U* own = p + link.parameter;
    const U* state = s + link.state;
    if (part.yield != nullptr) {
      Yield<U> yield;
      part.yield(own, *state, yield);
      yield.gain = yield.gain * U(relief.factor[top - 1]);
      const Input<U> shifted{in.x - yield.deflection, in.v, in.drive, in.time, in.age, in.a, in.jerk};
      if constexpr (std::is_same_v<U, Value>) {
        if (rates == nullptr) {
          return root(top - 1, p, s, shifted, *state, yield, relief).force;
        }
      }
      const U u = solve(top - 1, p, s, shifted, *state, yield, relief);
      if (rates != nullptr) {
        rates[link.state] = u;
      }
      return evaluate(top - 1, p, s, moved(shifted, yield.slope * u), relief, rates, forces_below);
    }
    Input<U> seen = in;
    if (part.drive != nullptr) {
      part.drive(own, state, seen);
    }
    U force = evaluate(top - 1, p, s, seen, relief, rates, forces_below);
    if (forces_below != nullptr) {
      forces_below[top - 1] = force;
    }
    if (rates != nullptr && link.states > 0) {
      if (part.loaded_rate != nullptr) {
        part.loaded_rate(own, state, in, force, rates + link.state);
      } else {
        part.rate(own, state, in, rates + link.state);
        if (part.settles >= 0) part.rest(own, state, in, rates + link.state);
      }
    }
    part.force(own, state, in, force);
    return force;
  }

  template <class U>
  static Input<U> moved(const Input<U>& in, const U& speed) {
    return {in.x, in.v - speed, in.drive, in.time, in.age, in.a, in.jerk};
  }

  // Rate u of the state of a series element above the links [0, top); `in` holds the deflected displacement.
  template <class U>
  U solve(std::size_t top, const U* p, const U* s, const Input<U>& in, const U& q, const Yield<U>& yield,
          const Relief<Value>& relief) const {
    if constexpr (std::is_same_v<U, Value>) {
      return root(top, p, s, in, q, yield, relief).u;
    } else {
      States<Value> state;
      const int below = links_[top].state;
      for (int i = 0; i < below; ++i) {
        state[static_cast<std::size_t>(i)] = value_of(s[i]);
      }
      const Yield<Value> values{value_of(yield.deflection), value_of(yield.slope), value_of(yield.bend),
                                value_of(yield.gain),       value_of(yield.hold),  value_of(yield.width)};
      const Input<Value> at = value_input(in);
      const Value u = root(top, values_.data(), state.data(), at, q.v, values, relief).u;
      const Value resistance = damping(top, values_.data(), state.data(), moved(at, values.slope * u), relief);
      const Value slope = fma(values.gain * values.slope, resistance, Value(1.0));
      const U known(u);
      const U force = evaluate(top, p, s, moved(in, yield.slope * known), relief, static_cast<U*>(nullptr));
      const U residual = known - yield.gain * (force - yield.hold * q);
      return chain(residual, u, Value(-1.0) / slope);
    }
  }

  // dF/dv of the links [0, top), by a difference that is small against the width of the laws' steepest steps.
  Value damping(std::size_t top, const Value* p, const Value* s, const Input<Value>& in,
                const Relief<Value>& relief) const {
    const Value h = fma(abs(in.v), Value(1e-3), Value(1e-6));
    Input<Value> above = in;
    Input<Value> below = in;
    above.v = in.v + h;
    below.v = in.v - h;
    const Value up = evaluate<Value>(top, p, s, above, relief, nullptr);
    const Value down = evaluate<Value>(top, p, s, below, relief, nullptr);
    return (up - down) / (above.v - below.v);
  }

  // The root of g, to where g is its own rounding.
  Root<Value> root(std::size_t top, const Value* p, const Value* s, const Input<Value>& in, const Value& q,
                   const Yield<Value>& yield, const Relief<Value>& relief) const {
    const Value held = yield.hold * q;
    Value force;
    const auto residual = [&](const Value& u) -> typename Secants<Value>::Residual {
      force = evaluate<Value>(top, p, s, moved(in, yield.slope * u), relief, nullptr);
      return {u - yield.gain * (force - held),
              Value(motion_.balance_tolerance) * (abs(u) + yield.gain * (abs(force) + abs(held)))};
    };
    // Where the links below hold the element, they move on as they did; else the element is taken to be at rest.
    const Value hold = yield.gain * yield.slope * relief.resistance[top];
    const auto held_back = hold > Value(0.1);
    const Value before =
        select(held_back, (in.v - relief.speed[top]) / select(held_back, yield.slope, Value(1.0)), Value(0.0));
    const Value g_before = residual(before).g;
    Secants<Value> secants(before, g_before);
    const Value u = before - g_before / (Value(1.0) + hold);
    secants.take(u, residual(u));
    secants.close_in(motion_.balance_iterations, residual);
    return {secants.u(), force};  // lanes that were done had the same u, and so the same force, to the end
  }

  // Bounds of the stiffness of link i, which moves at v where the recording moves at `speed` at most, and without its
  // state that rests at its bound at these rates.
  struct Bounds {
    Value whole;
    Value at_rest;
  };
  Bounds bounds_of(std::size_t i, const Value& v, double speed, const Value* rates) const {
    const Link& link = links_[i];
    const Value whole = stiffness_beyond(*link.values, values_.data() + link.parameter, still_[i], speed, abs(v));
    const int settles = link.values->settles;
    return {whole, settles < 0 ? whole : select(rests(rates[link.state + settles]), slack_[i], whole)};
  }

  const Motion& motion_;
  std::vector<Link> links_;  // law first
  std::size_t parameters_;
  int states_;
  const T* p_ = nullptr;
  std::vector<Value> values_;
  std::vector<Value> still_;  // stiffness bound of a link at rest
  std::vector<Value> slack_;  // in place of it and what speed adds while the link's state rests at its bound
};

}  // namespace hysteron::detail
