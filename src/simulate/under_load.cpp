#include "simulate/under_load.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "simulate/chain.hpp"
#include "simulate/march.hpp"

namespace hysteron {
namespace {

// A chain over one interval at a time, over which its series elements are known to deflect from D to D + D' t and the
// load from F to F + F' t.
template <class T>
class LoadedChain {
 public:
  using Value = value_t<T>;

  LoadedChain(const CompositeModel& model, const Motion& motion) : chain_(model), motion_(motion) {
    model.for_links([this](const Link& link) { yields_.push_back(link.part->on<T>().yield); });
    deflection_.resize(yields_.size());
    speed_.resize(yields_.size());
    at_sample_.resize(yields_.size());
  }

  [[nodiscard]] int states() const { return chain_.states(); }

  // Interval n: deflections at its start, and at its end with the parameters there; their states go on to its end.
  void enter(std::size_t n, const T* p, const T* p_end, T* state) {
    begin_ = motion_.time[n];
    force_ = motion_.load[n];
    const bool last = n >= motion_.intervals.size();
    const double length = last ? 1.0 : motion_.intervals[n].length;
    slope_ = last ? 0.0 : (motion_.load[n + 1] - force_) / length;
    moving_ = Value(0.0);
    for (std::size_t i = 0; i < yields_.size(); ++i) {
      if (yields_[i] == nullptr) continue;
      const auto& link = chain_.links[i];
      T& q = state[link.state];
      const Yield<T> now = under(i, p + link.parameter, force_, q);
      deflection_[i] = now.deflection;
      speed_[i] = T(0.0);
      T before(0.0);  // the speed over the interval before
      if (n > 0) {
        const double elapsed = motion_.time[n] - motion_.time[n - 1];
        T q_before = q - T(0.5 * elapsed * (motion_.load[n - 1] + force_)) * now.gain;
        before = (now.deflection - under(i, p + link.parameter, motion_.load[n - 1], q_before).deflection) *
                 T(1.0 / elapsed);
      }
      at_sample_[i] = before;
      if (last) continue;
      const double force_end = motion_.load[n + 1];
      Yield<T> then = under(i, p_end + link.parameter, force_end, q);
      q = q + T(0.5 * length) * (now.gain * T(force_) + then.gain * T(force_end));
      then = under(i, p_end + link.parameter, force_end, q);
      speed_[i] = (then.deflection - now.deflection) * T(1.0 / length);
      at_sample_[i] = n > 0 ? T(0.5) * (before + speed_[i]) : speed_[i];
      moving_ = moving_ + abs(value_of(speed_[i]));
    }
  }

  void rate(const T* p, const T* s, Input<T> in, T* rates) const {
    const T load = T(slope_) * (in.time - T(begin_)) + T(force_);
    walk(p, s, in, speed_, [&](const auto& link, const Input<T>& seen) {
      if (link.operations->loaded_rate != nullptr) {
        link.operations->loaded_rate(p + link.parameter, s + link.state, seen, load, rates + link.state);
      } else if (link.operations->rate != nullptr) {
        link.operations->rate(p + link.parameter, s + link.state, seen, rates + link.state);
      } else if (link.states > 0) {
        rates[link.state] = T(0.0);  // a series element, whose state is known
      }
    });
  }
  [[nodiscard]] bool settles() const { return chain_.settles(); }
  void rest(const T* p, const T* s, Input<T> in, T* rates) const {
    walk(p, s, in, speed_, [&](const auto& link, const Input<T>& seen) {
      if (link.operations->settles >= 0) {
        link.operations->rest(p + link.parameter, s + link.state, seen, rates + link.state);
      }
    });
  }
  // At the start of the interval.
  [[nodiscard]] T force(const T* p, const T* s, const Input<T>& in) const {
    std::array<Input<T>, max_links> seen;
    std::size_t at = chain_.links.size();
    walk(p, s, in, at_sample_, [&](const auto& /*link*/, const Input<T>& one) { seen[--at] = one; });
    T result(0.0);
    for (std::size_t i = 0; i < chain_.links.size(); ++i) {
      const auto& link = chain_.links[i];
      link.operations->force(p + link.parameter, s + link.state, seen[i], result);
    }
    return result;
  }
  [[nodiscard]] Value stiffness(const T* p, double speed) const {
    return bound(p, speed, [](const auto& /*link*/, const Value& whole) { return whole; });
  }
  [[nodiscard]] Value stiffness_now(const T* p, const T* /*s*/, const T* rates, const Input<T>& /*in*/, double speed,
                                    double /*change*/) const {
    return bound(p, speed, [&](const auto& link, const Value& whole) {
      return link.operations->settles < 0
                 ? whole
                 : select(detail::rests(value_of(rates[link.state + link.operations->settles])),
                          link.operations->slack(p + link.parameter), whole);
    });
  }
  static constexpr bool knows_kinks() { return false; }
  auto kinked(const T* p, const T* before, const Input<T>& in_before, const T* now, const Input<T>& in_now) const {
    return chain_.kinked(p, before, in_before, now, in_now);
  }
  auto woken(const T* before, const T* now, const Value& little) const { return chain_.woken(before, now, little); }

 private:
  // A series element under a force. The state of one that is held follows from it; of another it is given.
  Yield<T> under(std::size_t i, const T* own, double force, T& q) const {
    Yield<T> result;
    yields_[i](own, q, result);
    const auto held = value_of(result.hold) > Value(0.0);
    q = select(held, T(force) / select(held, result.hold, T(1.0)), q);
    yields_[i](own, q, result);
    return result;
  }

  // Hands every link, the outermost first, and what it sees to `take`, where elements deflect at these speeds.
  template <class Take>
  void walk(const T* p, const T* s, Input<T> in, const std::vector<T>& speed, Take&& take) const {
    const T elapsed = in.time - T(begin_);
    for (std::size_t i = chain_.links.size(); i-- > 0;) {
      const auto& link = chain_.links[i];
      take(link, in);
      if (yields_[i] != nullptr) {
        in.x = in.x - (deflection_[i] + speed_[i] * elapsed);
        in.v = in.v - speed[i];
      } else if (link.operations->drive != nullptr) {
        link.operations->drive(p + link.parameter, s + link.state, in);
      }
    }
  }
  // Behind the elements the links move faster by theirs.
  template <class Which>
  Value bound(const T* p, double speed, const Which& which) const {
    Value result(0.0);
    for (const auto& link : chain_.links) {
      if (link.operations->stiffness == nullptr) continue;
      const T* own = p + link.parameter;
      const Value still = link.operations->stiffness(own, 0.0);
      result =
          result + which(link, detail::stiffness_beyond(*link.operations, own, still, speed, Value(speed) + moving_));
    }
    return result;
  }

  Chain<T> chain_;
  const Motion& motion_;
  std::vector<decltype(PartOperations<T>::yield)> yields_;  // of each link; null where it is no series element
  std::vector<T> deflection_;
  std::vector<T> speed_;      // over the interval
  std::vector<T> at_sample_;  // at its start: the mean of this interval and the one before
  Value moving_{0.0};         // bound of all speeds together
  double begin_ = 0.0;
  double force_ = 0.0;
  double slope_ = 0.0;
};

// Knows its number of states while compiling.
template <class T, int N>
struct SizedLoadedChain : LoadedChain<T> {
  using LoadedChain<T>::LoadedChain;
  static constexpr int states() { return N; }
};

template <class T, class Loaded>
void run(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride, std::size_t begin,
         std::size_t end, T* state, T* out) {
  Loaded chain(model, motion);
  std::vector<T> between(p, p + model.parameter_count());
  std::array<T, static_cast<std::size_t>(max_states)> next;
  for (std::size_t n = begin; n < end; ++n) {
    const T* here = p + (n - begin) * stride;
    const bool last = n >= motion.intervals.size();
    std::copy_n(state, model.states(), next.begin());
    chain.enter(n, here, last ? here : here + stride, next.data());
    out[n - begin] = chain.force(here, state, detail::input_of_sample<T>(motion, n));
    if (last) {
      continue;
    }
    if (stride > 0) {
      detail::parameters_between(here, stride, between.data());
    }
    detail::in_parts(motion.intervals[n], [&](double from, double to) {
      detail::march_segment<T>(static_cast<const Loaded&>(chain), motion, n, from, to, between.data(), state);
    });
    model.for_links([&](const Link& link) {
      if (link.part->in_series()) {
        state[link.state] = next[static_cast<std::size_t>(link.state)];
      }
    });
  }
}

}  // namespace

template <class T>
void march_under_load(const CompositeModel& model, const Motion& motion, const T* p, std::size_t stride,
                      std::size_t begin, std::size_t end, T* state, T* out) {
  const auto march = [&]() {
    switch (model.states()) {
      case 1:
        return run<T, SizedLoadedChain<T, 1>>;
      case 2:
        return run<T, SizedLoadedChain<T, 2>>;
      case 3:
        return run<T, SizedLoadedChain<T, 3>>;
      case 4:
        return run<T, SizedLoadedChain<T, 4>>;
      default:
        return run<T, LoadedChain<T>>;
    }
  }();
  march(model, motion, p, stride, begin, end, state, out);
}

template void march_under_load<double>(const CompositeModel&, const Motion&, const double*, std::size_t, std::size_t,
                                       std::size_t, double*, double*);
template void march_under_load<Lanes>(const CompositeModel&, const Motion&, const Lanes*, std::size_t, std::size_t,
                                      std::size_t, Lanes*, Lanes*);
template void march_under_load<LaneDual>(const CompositeModel&, const Motion&, const LaneDual*, std::size_t,
                                         std::size_t, std::size_t, LaneDual*, LaneDual*);

}  // namespace hysteron
