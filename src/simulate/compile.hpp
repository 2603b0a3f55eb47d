// Turns a part's equations into its catalogue row: instantiates them for doubles, packs and duals, and for recording,
// in the part's own translation unit.
#pragma once

#include <algorithm>

#include "simulate/knowledge.hpp"
#include "simulate/march.hpp"
#include "simulate/part.hpp"
#include "simulate/traced.hpp"

namespace hysteron {

namespace detail {

template <class M>
inline constexpr std::size_t parameter_count = std::size(M::parameters);

template <class T, std::size_t N>
[[gnu::always_inline]] inline const std::array<T, N>& as_array(const T* p) {
  return *reinterpret_cast<const std::array<T, N>*>(p);
}

// Members are found by their names alone and then used: one that cannot be used as part.hpp says does not compile.
template <class M>
concept HasForce = requires {
  &M::template force<double>;
};
template <class M>
concept HasDrive = requires {
  &M::template drive<double>;
};
template <class M>
concept HasExcite = requires {
  &M::template excite<double>;
};
template <class M>
concept HasRecall = requires {
  &M::template recall<double>;
};
template <class M>
concept HasRate = requires {
  &M::template rate<double>;
};
// The force then depends on its own past.
template <class M>
concept HasLoadedRate = requires {
  &M::template loaded_rate<double>;
};
template <class M>
concept HasBegin = requires {
  &M::template begin<double>;
};
template <class M>
concept HasStiffness = requires {
  &M::template stiffness<double>;
};
template <class M>
concept Settles = requires {
  M::settles;
};
template <class M>
concept HasTowards = requires {
  &M::template towards<double>;
};
template <class M>
concept HasSlack = requires {
  &M::template slack<double>;
};
template <class M>
concept HasStiffnessNear = requires {
  &M::template stiffness_near<double>;
};
template <class M>
concept IsSeries = requires {
  &M::template yield<double>;
};

// Stands behind a law, never alone: laws have neither. An effect with none of both has a march that nobody asks for.
template <class M>
concept IsEffect = HasLoadedRate<M> || requires {
  M::knowledge;
};

template <class M>
constexpr int settling_state() {
  if constexpr (Settles<M>) {
    return M::settles;
  } else {
    return -1;
  }
}

// A part alone, fused for speed.
template <class M>
struct Fused {
  static constexpr int states() { return M::states; }
  static constexpr std::size_t parameters() { return parameter_count<M>; }
  template <class T>
  [[gnu::always_inline]] static void rate(const T* p, const T* s, const Input<T>& in, T* rates) {
    if constexpr (M::states > 0) {
      const auto result = M::rate(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in);
      repeat<M::states>([&](auto i) __attribute__((always_inline)) { rates[i] = result[i]; });
    }
  }
  static constexpr bool settles() { return Settles<M>; }
  template <class T>
  [[gnu::always_inline]] static void rest([[maybe_unused]] const T* p, [[maybe_unused]] const T* s,
                                          [[maybe_unused]] const Input<T>& in, [[maybe_unused]] T* rates) {
    if constexpr (Settles<M>) {
      rates[M::settles] = select(at_bound(value_of(s[M::settles]), towards(p, s, in)), T(0.0), rates[M::settles]);
    }
  }
  template <class T>
  [[gnu::always_inline]] static value_t<T> slack([[maybe_unused]] const T* p) {
    if constexpr (HasSlack<M>) {
      return M::slack(values(p));
    } else {
      return value_t<T>(0.0);
    }
  }
  template <class T>
  [[gnu::always_inline]] static value_t<T> stiffness_now(const T* p, const T* s, const T* rates, const Input<T>& in,
                                                         double speed, double change) {
    if constexpr (!Settles<M>) {
      return stiffness(p, speed);
    } else {
      value_t<T> bound = stiffness(p, speed);
      if constexpr (HasStiffnessNear<M>) {
        std::array<value_t<T>, M::states> state;
        repeat<M::states>([&](auto i) __attribute__((always_inline)) { state[i] = value_of(s[i]); });
        bound = M::stiffness_near(values(p), state, value_of(in.v), speed, change);
      }
      return select(rests(value_of(rates[M::settles])), slack(p), bound);
    }
  }
  // What drives the hysteresis and the hysteresis itself bend the equations where they change sign.
  static constexpr bool knows_kinks() { return Settles<M>; }
  template <class T>
  [[gnu::always_inline]] static auto kinked(const T* p, const T* before, const Input<T>& in_before, const T* now,
                                            const Input<T>& in_now) {
    if constexpr (Settles<M>) {
      return (towards(p, before, in_before) * towards(p, now, in_now) < value_t<T>(0.0)) |
             (value_of(before[M::settles]) * value_of(now[M::settles]) < value_t<T>(0.0));
    } else {
      return value_of(in_now.v) < value_of(in_now.v);
    }
  }
  template <class T>
  [[gnu::always_inline]] static auto woken(const T* before, const T* now, const value_t<T>& little) {
    constexpr auto k = static_cast<std::size_t>(std::max(settling_state<M>(), 0));
    return rests(value_of(before[k])) & (abs(value_of(now[k])) > little);
  }
  template <class T>
  [[gnu::always_inline]] static T force(const T* p, const T* s, const Input<T>& in) {
    if constexpr (HasForce<M>) {
      return M::force(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in, T(0.0));
    } else {
      return T(0.0);
    }
  }
  template <class T>
  [[gnu::always_inline]] static value_t<T> stiffness(const T* p, double speed) {
    if constexpr (M::states > 0) {
      return M::stiffness(values(p), speed);
    } else {
      return value_t<T>(0.0);
    }
  }
  // What drives the state that settles.
  template <class T>
  [[gnu::always_inline]] static value_t<T> towards(const T* p, const T* s, const Input<T>& in) {
    return value_of(M::towards(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in));
  }

 private:
  // Bounds need no derivatives.
  template <class T>
  [[gnu::always_inline]] static std::array<value_t<T>, parameter_count<M>> values(const T* p) {
    std::array<value_t<T>, parameter_count<M>> result;
    repeat<static_cast<int>(parameter_count<M>)>([&](auto i)
                                                     __attribute__((always_inline)) { result[i] = value_of(p[i]); });
    return result;
  }
};

template <class M, class T>
constexpr PartOperations<T> series_operations() {
  PartOperations<T> result;
  result.yield = [](const T* p, const T& q, Yield<T>& yield) {
    yield = M::yield(as_array<T, parameter_count<M>>(p), q);
  };
  result.force = [](const T*, const T*, const Input<T>&, T&) {};
  return result;
}

template <class M, class T>
constexpr PartOperations<T> operations() {
  PartOperations<T> result;
  if constexpr (HasExcite<M>) {
    result.excite = [](const T* p, T* memory, double elapsed, T& drive) {
      drive = M::excite(as_array<T, parameter_count<M>>(p),
                        *reinterpret_cast<std::array<T, excitation_memory>*>(memory), elapsed, drive);
    };
  }
  if constexpr (HasRecall<M>) {
    result.recall = [](const T* p, const Command& command, T& drive) {
      drive = M::recall(as_array<T, parameter_count<M>>(p), command);
    };
  }
  if constexpr (HasDrive<M>) {
    result.drive = [](const T* p, const T* s, Input<T>& in) {
      M::drive(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in);
    };
  }
  if constexpr (M::states > 0) {
    if constexpr (HasLoadedRate<M>) {
      result.loaded_rate = [](const T* p, const T* s, const Input<T>& in, const T& below, T* rates) {
        const auto values = M::loaded_rate(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in, below);
        std::copy(values.begin(), values.end(), rates);
      };
    } else {
      result.rate = [](const T* p, const T* s, const Input<T>& in, T* rates) { Fused<M>::rate(p, s, in, rates); };
    }
    if constexpr (HasBegin<M> && !std::is_same_v<T, Trace>) {
      result.begin = [](const T* p, std::span<const EarlierWork> earlier, T* s) {
        const auto values = M::begin(as_array<T, parameter_count<M>>(p), earlier);
        std::copy(values.begin(), values.end(), s);
      };
    }
    result.stiffness = [](const T* p, double speed) { return Fused<M>::stiffness(p, speed); };
    if constexpr (Settles<M>) {
      result.settles = M::settles;
      result.rest = [](const T* p, const T* s, const Input<T>& in, T* rates) { Fused<M>::rest(p, s, in, rates); };
      result.slack = [](const T* p) { return Fused<M>::slack(p); };
    }
  }
  if constexpr (HasForce<M>) {
    result.force = [](const T* p, const T* s, const Input<T>& in, T& force) {
      force = M::force(as_array<T, parameter_count<M>>(p), as_array<T, M::states>(s), in, force);
    };
  } else {
    result.force = [](const T*, const T*, const Input<T>&, T&) {};
  }
  if constexpr (!IsEffect<M> && !std::is_same_v<T, Trace>) {
    result.march = [](const Motion& motion, const T* p, std::size_t stride, std::size_t begin, std::size_t end,
                      T* state, T* out) { march<T>(Fused<M>{}, motion, p, stride, begin, end, state, out); };
  }
  return result;
}

template <class M>
constexpr bool has_parameter(std::string_view name) {
  return std::ranges::any_of(M::parameters, [&](const Parameter& own) { return own.name == name; });
}

// Whether what an effect says of its own parameters names ones that it has.
template <class M>
constexpr bool knows_its_parameters() {
  const Knowledge& known = M::knowledge;
  return std::ranges::all_of(
             known.holds, [](const Limit& row) { return row.parameter.empty() || has_parameter<M>(row.parameter); }) &&
         std::ranges::all_of(known.ends_as, [](const BoxLimit& row) { return has_parameter<M>(row.parameter); }) &&
         std::ranges::all_of(known.kindred,
                             [](const KindredParameter& row) { return has_parameter<M>(row.parameter); });
}

template <class M>
constexpr TracedPart traced_part() {
  if constexpr (IsSeries<M>) {
    return {series_operations<M, Trace>()};
  } else {
    TracedPart result{operations<M, Trace>()};
    if constexpr (Settles<M>) {
      result.towards = [](const Trace* p, const Trace* s, const Input<Trace>& in) {
        return Fused<M>::towards(p, s, in);
      };
    }
    if constexpr (HasStiffnessNear<M>) {
      result.stiffness_near = [](const Trace* p, const Trace* s, const Trace& v, double speed, double change) {
        return M::stiffness_near(as_array<Trace, parameter_count<M>>(p), as_array<Trace, M::states>(s), v, speed,
                                 change);
      };
    }
    return result;
  }
}
template <class M>
inline constexpr TracedPart traced = traced_part<M>();

}  // namespace detail

template <class M>
constexpr Part compile() {
  using namespace detail;
  static_assert(M::states <= max_states);
  static_assert(HasForce<M> || HasDrive<M> || HasExcite<M> || HasRecall<M> || IsSeries<M>,
                "the part does nothing: it has neither force nor drive, excite, recall or yield");
  if constexpr (IsSeries<M>) {
    static_assert(M::states == 1, "a series element has one state");
    static_assert(!HasForce<M> && !HasDrive<M> && !HasRate<M> && !HasLoadedRate<M> && !HasStiffness<M>,
                  "the yield of a series element says all that it does");
  } else {
    static_assert((M::states > 0) == (HasRate<M> || HasLoadedRate<M>), "states have a rate, and rates a state");
    static_assert(!(HasRate<M> && HasLoadedRate<M>), "rate and loaded_rate say the same");
    static_assert((M::states > 0) == HasStiffness<M>, "states have a stiffness");
    static_assert(M::states > 0 || !HasBegin<M>, "only states begin");
  }
  if constexpr (Settles<M>) {
    static_assert(HasRate<M> && M::settles >= 0 && M::settles < M::states, "settles is one of the states of a rate");
    static_assert(HasTowards<M>, "what settles is driven towards its bound");
    static_assert((M::states > 1) == HasSlack<M>, "the states beside the one that settles have a slack");
  } else {
    static_assert(!HasTowards<M> && !HasSlack<M> && !HasStiffnessNear<M>, "only what settles has these");
  }
  Part part;
  part.id = M::id;
  part.title = M::title;
  part.reference = M::reference;
  part.equations = M::equations;
  part.parameters = M::parameters;
  part.states = M::states;
  part.traced = &traced<M>;
  if constexpr (requires { M::starts; }) {
    static_assert(std::size(M::starts) == 8);
    part.starts = M::starts;
  }
  if constexpr (requires { M::alternative; }) {
    part.alternative = M::alternative;
  }
  if constexpr (requires { M::knowledge; }) {
    static_assert(knows_its_parameters<M>(), "knowledge names a parameter that the effect does not have");
    part.knowledge = &M::knowledge;
  }
  if constexpr (IsSeries<M>) {
    part.bends = true;
    part.on_double = series_operations<M, double>();
    part.on_lanes = series_operations<M, Lanes>();
    part.on_dual = series_operations<M, LaneDual>();
  } else {
    part.bends = HasLoadedRate<M> || requires { M::bends; };
    part.on_double = operations<M, double>();
    part.on_lanes = operations<M, Lanes>();
    part.on_dual = operations<M, LaneDual>();
    if constexpr (wide_lanes_pay && !HasLoadedRate<M>) {
      part.on_wide_lanes = operations<M, WideLanes>();
    }
  }
  return part;
}

}  // namespace hysteron
