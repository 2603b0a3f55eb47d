// A part: a damper law or a physical effect. Both have the same shape, so that augmenting a model is putting a part
// behind it. A part is a struct whose members say what it does. A member is found by its name: one of another signature
// does not compile, nor does a part without what goes with what it has (simulate/compile.hpp). All parts have
//   id, title, reference, equations    text
//   parameters                         the card (simulate/parameter.hpp)
//   states                             number of own state variables
// and functions, templates on the scalar T, of which a part has those that it needs, one at least. p is
// std::array<T, parameter count> in the order of the card, s std::array<T, states>, in an Input<T>.
//   force(p, s, in, below) -> T        the force; `below` is that of the parts below, 0 for a law. An effect without it
//                                      lets the force pass
//   drive(p, s, in)                    turns `in` into what the parts below see
//   excite(p, memory, elapsed, drive) -> T    the drive that the laws of the parameters see, of the one recorded at a
//                                      sample; std::array<T, excitation_memory> memory, see PartOperations
//   recall(p, command) -> T            the drive of another instant, likewise, before any excite
// A part with states has besides
//   rate(p, s, in) -> array<T, states>         their time derivatives, or, where they depend on the force below,
//   loaded_rate(p, s, in, below) -> array<T, states>
//   begin(p, earlier) -> array<T, states>      optional, of states that count from the first sample of a recording, so
//                                      those there, after the work that recordings before it did; others are zero
//   stiffness(p, speed) -> T           bound of |d rate / d state| in 1/s at |velocity| <= speed: linear in the speed,
//                                      or rising ever less with it, which marches build on
//                                      (simulate/march.hpp)
// A part with a state that |state| = 1 bounds and holds, as a hysteresis that has yielded, while what drives it keeps
// its sign, has besides, so that steps need not resolve it then,
//   settles                            which state
//   towards(p, s, in) -> T             what drives it: its sign counts
//   slack(p) -> T                      with other states: bound as stiffness of those meanwhile
//   stiffness_near(p, s, v, speed, change) -> T    optional: a closer bound as stiffness while the velocity, now v,
//   stays
//                                      below speed and within change of v
// A series element, behind which everything nearer to the law is deflected, has one state q and only
//   yield(p, q) -> Yield<T>
// An effect may have besides
//   starts                             eight values (Part::starts)
//   bends = true                       where its force is not affine in the force below (Part::bends); so are those of
//                                      series elements and of parts with loaded_rate, which need not say so
//   knowledge                          what is known of it beside its equations (simulate/knowledge.hpp)
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "core/earlier_work.hpp"
#include "scalar/math.hpp"
#include "simulate/command.hpp"
#include "simulate/parameter.hpp"

namespace hysteron {

// What a part sees at an instant.
template <class T>
struct Input {
  T x;      // displacement, m
  T v;      // velocity, m/s
  T drive;  // current or voltage, A or V
  T time;   // s since the start of the recording
  T age;    // s since the march began: later than time where a period is marched beforehand
  T a;      // acceleration of the recorded motion, m/s^2, also behind series elements
  T jerk;   // m/s^3, likewise
};

// Deflection D(q) of a series element and the law of its state, whose element force is that of the links below it:
//   q' = gain (F - hold q)
template <class T>
struct Yield {
  T deflection;  // D, m
  T slope;       // D' >= 0
  T bend;        // D''
  T gain;        // > 0, or 0 where the element is rigid
  T hold;        // >= 0
  T width;       // change of q from 0 over which D bends; 0 where D is straight
};

// Samples of a motion prepared for marching (simulate/motion.hpp).
struct Motion;

// Values an excite operation keeps from one sample to the next.
inline constexpr std::size_t excitation_memory = 2;

// Directions differentiated in one sweep.
inline constexpr int sweep_directions = 4;
using LaneDual = Dual<Lanes, sweep_directions>;

// The operations of a part on one scalar type.
template <class T>
struct PartOperations {
  using Value = value_t<T>;
  void (*drive)(const T* p, const T* s, Input<T>& in) = nullptr;
  void (*rate)(const T* p, const T* s, const Input<T>& in, T* rates) = nullptr;
  void (*force)(const T* p, const T* s, const Input<T>& in, T& force) = nullptr;
  Value (*stiffness)(const T* p, double speed) = nullptr;
  // Where the part's state number `settles` (-1: none) rests at its bound, `rest` sets its rate to exactly 0.
  int settles = -1;
  void (*rest)(const T* p, const T* s, const Input<T>& in, T* rates) = nullptr;
  Value (*slack)(const T* p) = nullptr;
  // The part's states at the start of a recording, where it has a past; nullptr: they are zero.
  void (*begin)(const T* p, std::span<const EarlierWork> earlier, T* s) = nullptr;
  // As rate, with the force below.
  void (*loaded_rate)(const T* p, const T* s, const Input<T>& in, const T& below, T* rates) = nullptr;
  void (*yield)(const T* p, const T& q, Yield<T>& result) = nullptr;
  // The drive that acts at a sample in place of the recorded one there, before any excite operation.
  void (*recall)(const T* p, const Command& command, T& drive) = nullptr;
  // Replaces the drive of a sample, `elapsed` s after the one before (negative: the first) by the one that acts.
  // `memory` holds excitation_memory values that belong to this part and recording.
  void (*excite)(const T* p, T* memory, double elapsed, T& drive) = nullptr;
  // March of this part alone over samples [begin, end): writes force of sample n to out[n - begin], and leaves the
  // state of sample `end` in `state`. Parameters of sample n stand at p + (n - begin) * stride, those of sample `end`
  // too where the motion has one; between samples the mean of both acts. Stride 0 is constant. Effects have none.
  void (*march)(const Motion& motion, const T* p, std::size_t stride, std::size_t begin, std::size_t end, T* state,
                T* out) = nullptr;
};

struct Knowledge;
// The operations on the recording scalar (simulate/traced.hpp).
struct TracedPart;

// A catalogue row of a law or an effect.
struct Part {
  std::string_view id;
  std::string_view title;
  std::string_view reference;
  std::span<const std::string_view> equations;
  std::span<const Parameter> parameters;
  int states = 0;
  // Parts of the first parameter's range, off its neutral value, to start a search from: eight of them, for effects
  // that do nothing below a threshold. Empty for the usual ones.
  std::span<const double> starts;
  bool bends = false;        // the force is not affine in the force below, so that parameters below are not linear
  bool alternative = false;  // a damper law that `diagnose` tries in place of the one asked for
  const Knowledge* knowledge = nullptr;  // of an effect that says something of itself
  PartOperations<double> on_double;
  PartOperations<Lanes> on_lanes;
  PartOperations<WideLanes> on_wide_lanes;  // where wide_lanes_pay, of parts that do not balance
  PartOperations<LaneDual> on_dual;
  const TracedPart* traced = nullptr;

  // Shares its force with what is below and takes part of the motion.
  [[nodiscard]] bool in_series() const { return on_double.yield != nullptr; }
  // Moves as the force says: a march solves for the balance of both.
  [[nodiscard]] bool balances() const { return in_series() || on_double.loaded_rate != nullptr; }

  template <class T>
  [[nodiscard]] const PartOperations<T>& on() const {
    if constexpr (std::is_same_v<T, double>) {
      return on_double;
    } else if constexpr (std::is_same_v<T, Lanes>) {
      return on_lanes;
    } else if constexpr (std::is_same_v<T, WideLanes>) {
      return on_wide_lanes;
    } else {
      return on_dual;
    }
  }
};

std::span<const Part* const> model_catalogue();
std::span<const Part* const> effect_catalogue();
// nullptr when there is none.
const Part* find_model(std::string_view id);
const Part* find_effect(std::string_view id);

}  // namespace hysteron
