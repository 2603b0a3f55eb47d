// The integrator: classical Runge-Kutta of fourth order with as many sub-steps between two samples as the stiffness
// bound of the equations asks for, per lane. h lambda <= step_limit (motion.hpp) keeps every lane inside the
// stability region (2.78) for every parameter set and sampling, and the step count is finite because the bound is.
// Sub-steps of lanes that need fewer are masked, so a lane does not depend on its company. Steps land on velocity
// reversals, where hysteresis equations have a kink, and on corners, where the velocity has a jump. Hysteresis that has
// yielded rests at its bound, and steps need not resolve it until it turns; kinks at places that are not known
// beforehand are looked for, and passed in small steps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "simulate/motion.hpp"
#include "simulate/part.hpp"

namespace hysteron {

inline constexpr int max_states = 16;

namespace detail {

// Smallest integer not below a, for |a| < 2^51.
template <class V>
[[gnu::always_inline]] inline V ceil_value(const V& a) {
  const V rounded = (a + V(0x1.8p52)) - V(0x1.8p52);
  return select(rounded < a, rounded + V(1.0), rounded);
}
[[gnu::always_inline]] inline double largest(double a) { return a; }
template <int Vectors>
[[gnu::always_inline]] inline double largest(const Pack<Vectors>& a) {
  double result = a.lane(0);
  for (int i = 1; i < Pack<Vectors>::lanes; ++i) {
    result = std::max(result, a.lane(i));
  }
  return result;
}

// a b + c with a factor that has no derivatives.
template <class T>
[[gnu::always_inline]] inline T scaled_sum(const value_t<T>& a, const T& b, const T& c) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    return fma(a, b, c);
  } else {
    T r;
    r.v = fma(a, b.v, c.v);
    repeat<T::directions>([&](auto i) __attribute__((always_inline)) { r.d[i] = fma(a, b.d[i], c.d[i]); });
    return r;
  }
}

// Within interval n, on the part of it where `course` holds.
template <class T, class V>
[[gnu::always_inline]] inline Input<T> input_at(const Motion& motion, std::size_t n, const MotionCourse& course,
                                                const V& theta) {
  const MotionInterval& interval = motion.intervals[n];
  const V time = fma(V(interval.length), theta, V(motion.time[n]));
  return {T(cubic(course.x, theta)),
          T(cubic(course.v, theta)),
          motion.drive.empty() ? T(0.0) : T(fma(V(motion.drive[n + 1] - motion.drive[n]), theta, V(motion.drive[n]))),
          T(time),
          T(time + V(motion.lead)),
          T(cubic(interval.a, theta)),
          T(cubic_slope(interval.a, theta) / V(interval.length))};
}

// Equals input_at theta = 0 unless a corner is near: the polynomials' constant terms are the samples.
template <class T>
[[gnu::always_inline]] inline Input<T> input_of_sample(const Motion& motion, std::size_t n) {
  return {T(motion.x[n]),
          T(motion.v[n]),
          T(motion.drive.empty() ? 0.0 : motion.drive[n]),
          T(motion.time[n]),
          T(motion.time[n] + motion.lead),
          T(motion.a[n]),
          T(motion.jerk[n])};
}

// Equals input_at theta = 1/2 or 1, from stored values: most intervals need one step only.
template <class T>
[[gnu::always_inline]] inline Input<T> input_stored(const Motion& motion, std::size_t n, double theta,
                                                    const double (&stored)[4]) {
  return {T(stored[0]),
          T(stored[1]),
          T(motion.drive.empty() ? 0.0 : fma(motion.drive[n + 1] - motion.drive[n], theta, motion.drive[n])),
          T(fma(motion.intervals[n].length, theta, motion.time[n])),
          T(fma(motion.intervals[n].length, theta, motion.time[n]) + motion.lead),
          T(stored[2]),
          T(stored[3])};
}

// Chains that know their size while compiling keep states, stages and parameters in registers or on the stack, where
// no store to the output can alias them.
template <class Chain>
concept FixedStates = requires {
  typename std::integral_constant<int, Chain::states()>;
};
template <class Chain>
concept FixedChain = FixedStates<Chain> && requires {
  typename std::integral_constant<std::size_t, Chain::parameters()>;
};

template <int N, class F>
[[gnu::always_inline]] inline void for_states(int states, F&& f) {
  if constexpr (N >= 0) {
    repeat<N>(f);
  } else {
    for (int i = 0; i < states; ++i) {
      f(i);
    }
  }
}

template <class Chain>
constexpr int fixed_states() {
  if constexpr (FixedStates<Chain>) {
    return Chain::states();
  } else {
    return -1;
  }
}

template <class T, int N>
using StateArray = std::array<T, static_cast<std::size_t>(N < 0 ? max_states : std::max(N, 1))>;

template <class T, class Chain>
class Parameters {
 public:
  [[gnu::always_inline]] explicit Parameters(const T* p) {
    if constexpr (FixedChain<Chain>) {
      repeat<static_cast<int>(Chain::parameters())>([&](auto i) __attribute__((always_inline)) { copy_[i] = p[i]; });
    } else {
      copy_ = p;
    }
  }
  [[nodiscard, gnu::always_inline]] const T* data() const {
    if constexpr (FixedChain<Chain>) {
      return copy_.data();
    } else {
      return copy_;
    }
  }

 private:
  template <class C>
  struct Storage {
    using type = const T*;
  };
  template <FixedChain C>
  struct Storage<C> {
    using type = std::array<T, C::parameters()>;
  };
  typename Storage<Chain>::type copy_;
};

// Whether a state of bound 1 that `towards` drives is as good as there: nothing is left to follow until that turns.
// What is given away, 1e-10 of the bound, is below every tolerance.
template <class V>
[[gnu::always_inline]] inline auto at_bound(const V& state, const V& towards) {
  const V reached = abs(state);
  return (reached > V(1.0 - 1e-10)) & (reached < V(1.0 + 1e-10)) & (state * towards > V(0.0));
}
// Whether a rate was set to 0 because its state is at its bound.
template <class V>
[[gnu::always_inline]] inline auto rests(const V& rate) {
  return abs(rate) < V(1e-300);
}

// Bound of a part's stiffness at speeds that lanes have of their own, `slowest` (m/s) at least; `still` is that at
// rest. It is linear in the speed or rises ever less (part.hpp): beyond `slowest` it stays below the line from rest to
// there.
template <class T>
[[gnu::always_inline]] inline value_t<T> stiffness_beyond(const PartOperations<T>& part, const T* own,
                                                          const value_t<T>& still, double slowest,
                                                          const value_t<T>& speed) {
  using Value = value_t<T>;
  const double known = std::max(slowest, 1e-9);
  const Value moving = part.stiffness(own, known);
  return fma((moving - still) * Value(1.0 / known), max(speed - Value(known), Value(0.0)), moving);
}

inline double coarseness(const Motion& motion, double length) {
  return 1.0 + motion.finer_when_long * std::min(1.0, length / 5e-3);
}
// Bound of the change of v over an interval with this course.
inline double change_of_velocity(const MotionCourse& course) {
  const double* c = course.v;
  return std::fabs(c[1]) + 2.0 * std::fabs(c[2]) + 3.0 * std::fabs(c[3]);
}
// Whether the velocity changes sign behind interval n, as far as its own end tells: along a parabola.
inline bool reversal_expected(const Motion& motion, std::size_t n) {
  const double h = motion.intervals[n].length;
  const double v = motion.v[n + 1];
  return v * (v + h * (velocity_slope(motion, n + 1) + 0.5 * h * motion.jerk[n + 1])) < 0.0;
}
[[gnu::always_inline]] inline bool near_reversal(const Motion& motion, std::size_t n) {
  if (motion.intervals[n].reversal || (n > 0 && motion.intervals[n - 1].reversal)) return true;
  if (!motion.foresight) return reversal_expected(motion, n);
  return n + 1 < motion.intervals.size() && motion.intervals[n + 1].reversal;
}

// Rates within a step, and the states they are taken at.
template <class T, int N>
struct Stages {
  StateArray<T, N> k2;
  StateArray<T, N> k3;
  StateArray<T, N> k4;
  StateArray<T, N> trial;
};

// One step of length h from `state`, whose rates k1 are, into `next`; rate(state, input, rates).
template <int N, class T, class Rate>
[[gnu::always_inline]] inline void advance(const Rate& rate, int states, const value_t<T>& h,
                                           const StateArray<T, N>& k1, const Input<T>& at_middle,
                                           const Input<T>& at_end, const StateArray<T, N>& state, Stages<T, N>& stages,
                                           StateArray<T, N>& next) {
  using Value = value_t<T>;
  const Value half = Value(0.5) * h;
  const Value sixth = Value(1.0 / 6.0) * h;
  const auto shift = [&](const Value& step, const StateArray<T, N>& k) __attribute__((always_inline)) {
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { stages.trial[i] = scaled_sum(step, k[i], state[i]); });
  };
  shift(half, k1);
  rate(stages.trial, at_middle, stages.k2);
  shift(half, stages.k2);
  rate(stages.trial, at_middle, stages.k3);
  shift(h, stages.k3);
  rate(stages.trial, at_end, stages.k4);
  for_states<N>(
      states, [&](auto i) __attribute__((always_inline)) {
        const T between = stages.k2[i] + stages.k3[i];
        next[i] = scaled_sum(sixth, scaled_sum(Value(2.0), between, k1[i] + stages.k4[i]), state[i]);
      });
}

// How much finer than smooth equations need the sub-steps of interval n are.
inline double fineness(const Motion& motion, std::size_t n) {
  const double coarse = coarseness(motion, motion.intervals[n].length);
  return near_reversal(motion, n) ? std::max(motion.finer_at_reversals, coarse) : coarse;
}

// The parts of interval n that are marched one after the other, up to a reversal or a corner and from it:
// march_part(from, to).
template <class MarchPart>
[[gnu::always_inline]] inline void in_parts(const MotionInterval& interval, const MarchPart& march_part) {
  if (interval.split_at > 0.0) march_part(0.0, interval.split_at);
  if (interval.split_at < 1.0) march_part(interval.split_at, 1.0);
}

// The part [from, from + span] of interval n.
struct Segment {
  Segment(const Motion& of, std::size_t interval_index, double begin, double end)
      : motion(of),
        n(interval_index),
        course(course_from(of, of.intervals[n], begin)),
        from(begin),
        span(end - begin) {}

  const Motion& motion;
  std::size_t n;
  const MotionCourse& course;
  double from;
  double span;

  [[nodiscard]] const MotionInterval& interval() const { return motion.intervals[n]; }
  [[nodiscard]] double length() const { return interval().length * span; }  // s
  // Sub-steps at a bound of the stiffness in 1/s, `finer` times as many as equations without kinks need. One for NaN:
  // such a lane must not stop its neighbours.
  template <class V>
  [[nodiscard, gnu::always_inline]] V count(const V& stiffness, double finer) const {
    const V bound = stiffness * V(length() * finer / motion.step_limit);
    return select(bound > V(1.0), min(ceil_value(bound), V(motion.most_substeps)), V(1.0));
  }
};

// Advances the state over a segment in `count` equal sub-steps a lane. rate(state, input, rates, active): lanes that
// are not active are done, what they are given is not used. `known`, if not null, holds the rates at the start.
template <int N, class T, class Rate>
[[gnu::always_inline]] inline void sub_steps(const Rate& rate, int states, const Segment& segment,
                                             const value_t<T>& count, const StateArray<T, N>* known,
                                             StateArray<T, N>& state) {
  using Value = value_t<T>;
  const auto input = [&](const Value& theta) __attribute__((always_inline)) {
    return input_at<T>(segment.motion, segment.n, segment.course, theta);
  };
  const int most = static_cast<int>(largest(count));
  const Value inverse = Value(1.0) / count;
  const Value h = Value(segment.length()) * inverse;
  StateArray<T, N> k1;
  if (known != nullptr) {
    k1 = *known;
  }
  StateArray<T, N> next;
  Value theta(segment.from);
  for (int k = 0; k < most; ++k) {
    const double step = k;
    const Value middle = fma(Value(segment.span * (step + 0.5)), inverse, Value(segment.from));
    const Value end = fma(Value(segment.span * (step + 1.0)), inverse, Value(segment.from));
    const auto active = Value(step) < count;
    const auto active_rate = [&](const StateArray<T, N>& s, const Input<T>& in, StateArray<T, N>& rates)
        __attribute__((always_inline)) {
      rate(s, in, rates, active);
    };
    if (k > 0 || known == nullptr) {
      active_rate(state, input(theta), k1);
    }
    Stages<T, N> stages;
    advance<N, T>(active_rate, states, h, k1, input(middle), input(end), state, stages, next);
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { state[i] = select(active, next[i], state[i]); });
    theta = end;
  }
}

// Lanes of up to so many sub-steps are not worth a trial.
inline constexpr double few_substeps = 2.0;

// sub_steps with as many steps as do where the equations have no kink inside and what rests at its bound stays there; a
// lane that proves to be none of these goes back and takes the steps that it was to be spared. False, and nothing done,
// where no lane would be spared any. Lanes that are not spared any get the same bits in any company.
template <int N, class T, class Chain>
[[gnu::always_inline]] inline bool fewer_sub_steps(const Chain& system, const T* p, int states, const Segment& segment,
                                                   double finer, const value_t<T>& count, StateArray<T, N>& state) {
  using Value = value_t<T>;
  const auto many = count > Value(few_substeps);
  if (!system.settles() || !any(many)) {
    return false;
  }
  const auto rate = [&](const StateArray<T, N>& s, const Input<T>& in, StateArray<T, N>& rates, const auto& /*active*/)
      __attribute__((always_inline)) {
    system.rate(p, s.data(), in, rates.data());
  };
  const StateArray<T, N> before = state;
  const Input<T> in_before = input_at<T>(segment.motion, segment.n, segment.course, Value(segment.from));
  StateArray<T, N> moving;
  rate(before, in_before, moving, many);
  StateArray<T, N> rates_before = moving;
  system.rest(p, before.data(), in_before, rates_before.data());
  const Value bound = system.stiffness_now(p, before.data(), rates_before.data(), in_before, segment.interval().speed,
                                           change_of_velocity(segment.course) * segment.span);
  const double smooth = std::sqrt(coarseness(segment.motion, segment.interval().length));
  const Value fewer = select(many, min(segment.count(bound, system.knows_kinks() ? smooth : finer), count), count);
  const auto tries = fewer < count;
  if (!any(tries)) {
    return false;
  }
  const auto only_where_tried = [&](StateArray<T, N> & rested, const StateArray<T, N>& not_rested)
      __attribute__((always_inline)) {
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { rested[i] = select(tries, rested[i], not_rested[i]); });
  };
  only_where_tried(rates_before, moving);
  const Value little(1e-9 / segment.length());
  auto failed = count < Value(0.0);
  const auto watched = [&](const StateArray<T, N>& s, const Input<T>& in, StateArray<T, N>& rates, const auto& active)
      __attribute__((always_inline)) {
    rate(s, in, moving, active);
    rates = moving;
    system.rest(p, s.data(), in, rates.data());
    only_where_tried(rates, moving);
    failed = failed | (active & (system.woken(rates_before.data(), rates.data(), little) |
                                 system.kinked(p, before.data(), in_before, s.data(), in)));
  };
  sub_steps<N, T>(watched, states, segment, fewer, &rates_before, state);
  failed = failed & tries;
  if (any(failed)) {
    StateArray<T, N> again = before;
    sub_steps<N, T>(rate, states, segment, select(failed, count, Value(1.0)), nullptr, again);
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { state[i] = select(failed, again[i], state[i]); });
  }
  return true;
}

// Advances the state over a segment in as many sub-steps as the stiffness asks for.
template <int N, class T, class Chain>
[[gnu::always_inline]] inline void enough_sub_steps(const Chain& system, const T* p, int states, const Segment& segment,
                                                    StateArray<T, N>& state) {
  const double finer = fineness(segment.motion, segment.n);
  const value_t<T> count = segment.count(system.stiffness(p, segment.interval().speed), finer);
  if (fewer_sub_steps<N, T>(system, p, states, segment, finer, count, state)) return;
  const auto rate = [&](const StateArray<T, N>& s, const Input<T>& in, StateArray<T, N>& rates, const auto& /*active*/)
      __attribute__((always_inline)) {
    system.rate(p, s.data(), in, rates.data());
  };
  sub_steps<N, T>(rate, states, segment, count, nullptr, state);
}

// Advances the state over the part [from, to] of interval n.
template <class T, class Chain>
[[gnu::noinline, gnu::flatten]] void march_segment(const Chain& system, const Motion& motion, std::size_t n,
                                                   double from, double to, const T* __restrict parameters,
                                                   T* __restrict result) {
  constexpr int N = fixed_states<Chain>();
  const int states = system.states();
  const Parameters<T, Chain> copy(parameters);
  StateArray<T, N> state;
  for_states<N>(
      states, [&](auto i) __attribute__((always_inline)) { state[i] = result[i]; });
  enough_sub_steps<N, T>(system, copy.data(), states, Segment(motion, n, from, to), state);
  for_states<N>(
      states, [&](auto i) __attribute__((always_inline)) { result[i] = state[i]; });
}

// march_constant over samples [begin, end), several of them so that what depends on parameters alone is computed once,
// and apart from its loop, which would be short of registers beside this one.
template <class T, class Chain>
[[gnu::noinline, gnu::flatten]] void march_in_segments(const Chain& system, const Motion& motion,
                                                       const T* __restrict parameters, std::size_t begin,
                                                       std::size_t end, T* __restrict result, T* __restrict out) {
  constexpr int N = fixed_states<Chain>();
  const int states = system.states();
  const Parameters<T, Chain> copy(parameters);
  const T* p = copy.data();
  StateArray<T, N> state;
  for_states<N>(
      states, [&](auto i) __attribute__((always_inline)) { state[i] = result[i]; });
  for (std::size_t n = begin; n < end; ++n) {
    out[n - begin] = system.force(p, state.data(), input_of_sample<T>(motion, n));
    if (n >= motion.intervals.size()) continue;
    // Up to a reversal or a corner and from it, in a loop so that the steps are compiled once.
    const double split_at = motion.intervals[n].split_at;
    const std::array<double, 3> ends = {0.0, split_at, 1.0};
    for (std::size_t part = split_at > 0.0 ? 0 : 1; part < (split_at < 1.0 ? 2U : 1U); ++part) {
      enough_sub_steps<N, T>(system, p, states, Segment(motion, n, ends[part], ends[part + 1]), state);
    }
  }
  for_states<N>(
      states, [&](auto i) __attribute__((always_inline)) { result[i] = state[i]; });
}

// Intervals checked at once for needing a single step.
inline constexpr std::size_t block_length = 8;

// Parameters that act over an interval, from those at its ends: of second order in its length where they vary.
template <class T>
void parameters_between(const T* p, std::size_t stride, T* result) {
  for (std::size_t j = 0; j < stride; ++j) {
    result[j] = T(0.5) * (p[j] + p[stride + j]);
  }
}

// march with constant parameters.
template <class T, class Chain>
[[gnu::noinline, gnu::flatten]] void march_constant(const Chain& system, const Motion& motion,
                                                    const T* __restrict parameters, std::size_t begin, std::size_t end,
                                                    T* __restrict result, T* __restrict out) {
  using Value = value_t<T>;
  constexpr int N = fixed_states<Chain>();
  const int states = system.states();
  const Parameters<T, Chain> copy(parameters);
  const T* p = copy.data();
  StateArray<T, N> state;
  const auto load = [&]() __attribute__((always_inline)) {
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { state[i] = result[i]; });
  };
  const auto store = [&]() __attribute__((always_inline)) {
    for_states<N>(
        states, [&](auto i) __attribute__((always_inline)) { result[i] = state[i]; });
  };
  const auto rate = [&](const StateArray<T, N>& s, const Input<T>& in, StateArray<T, N>& rates)
      __attribute__((always_inline)) {
    system.rate(p, s.data(), in, rates.data());
  };
  load();
  const std::size_t intervals = states == 0 ? 0 : motion.intervals.size();
  for (std::size_t first = begin; first < end; first += block_length) {
    const std::size_t last = std::min(first + block_length, end);
    // The bound grows with speed and with length (every rounding is monotone), so where the largest of a block ask for
    // one step, each interval of the block does.
    bool single = true;
    if (states > 0) {
      double speed = 0.0;
      double length = 0.0;
      for (std::size_t n = first; n < std::min(last, intervals); ++n) {
        speed = std::max(speed, motion.intervals[n].speed);
        length = std::max(length, motion.intervals[n].length);
      }
      single = !any(system.stiffness(p, speed) * Value(length * coarseness(motion, length) / motion.step_limit) >
                    Value(1.0));
    }
    const auto in_segments = [&](std::size_t from, std::size_t to) {
      store();
      march_in_segments<T>(system, motion, parameters, from, to, result, out + (from - begin));
      load();
    };
    if (!single) {
      in_segments(first, last);
      continue;
    }
    for (std::size_t n = first; n < last; ++n) {
      if (n < intervals && (near_reversal(motion, n) || motion.intervals[n].corner >= 0)) {
        in_segments(n, n + 1);
        continue;
      }
      const Input<T> start = input_of_sample<T>(motion, n);
      out[n - begin] = system.force(p, state.data(), start);
      if (n >= intervals) continue;
      const MotionInterval& interval = motion.intervals[n];
      StateArray<T, N> k1;
      StateArray<T, N> next;
      Stages<T, N> stages;
      rate(state, start, k1);
      advance<N, T>(rate, states, Value(interval.length), k1, input_stored<T>(motion, n, 0.5, interval.middle),
                    input_stored<T>(motion, n, 1.0, interval.end), state, stages, next);
      for_states<N>(
          states, [&](auto i) __attribute__((always_inline)) { state[i] = next[i]; });
    }
  }
  store();
}

}  // namespace detail

// Chain: states(), rate(p, s, in, rates), force(p, s, in) -> T, stiffness(p, speed) -> value_t<T>, which grows with
// speed; settles(), whether a state may come to rest at its bound; rest(p, s, in, rates), which sets the rates of those
// to 0; stiffness_now(p, s, rates, in, speed, change), the bound without what the rates say is at rest while v stays
// within `change` of in.v; woken(before, now, little), the lanes in which a rate that was at rest is larger than
// `little`; knows_kinks(), whether kinked(p, s, in, s_now, in_now) tells the lanes that passed a kink in between.
template <class T, class Chain>
void march(const Chain& system, const Motion& motion, const T* __restrict p, std::size_t stride, std::size_t begin,
           std::size_t end, T* __restrict state, T* __restrict out) {
  if (stride == 0) {
    detail::march_constant<T>(system, motion, p, begin, end, state, out);
    return;
  }
  T last{};  // the force with the parameters of an interval, which is that of no sample
  std::vector<T> between(stride);
  for (std::size_t n = begin; n < end; ++n) {
    const T* here = p + (n - begin) * stride;
    out[n - begin] = system.force(here, state, detail::input_of_sample<T>(motion, n));
    if (system.states() > 0 && n < motion.intervals.size()) {
      detail::parameters_between(here, stride, between.data());
      detail::march_constant<T>(system, motion, between.data(), n, n + 1, state, &last);
    }
  }
}

}  // namespace hysteron
