#include "bench/fused_kernels.hpp"

#include <array>

#include "scalar/math.hpp"

namespace hysteron::bench {
namespace {

// |z|^n (share |u| sgn(z) + (1 - share) u), over x_y as all constants are.
template <bool KneeOfOne>
struct Hysteresis {
  Lanes per_yield;
  Lanes with_sign;
  Lanes without;
  Lanes n;

  [[gnu::always_inline]] Hysteresis() = default;
  [[gnu::always_inline]] Hysteresis(const Lanes& x_y, const Lanes& share, const Lanes& knee)
      : per_yield(Lanes(1.0) / x_y), with_sign(share * per_yield), without((Lanes(1.0) - share) * per_yield), n(knee) {}

  [[nodiscard, gnu::always_inline]] Lanes rate(const Lanes& z, const Lanes& u) const {
    const Lanes held = with_sign * abs(u);
    if constexpr (KneeOfOne) {
      return fma(-held, z, fma(-without * u, abs(z), per_yield * u));
    } else {
      const Lanes against = fma(without, u, select(z < Lanes(0.0), -held, held));
      return fma(-pow(abs(z), n), against, per_yield * u);
    }
  }
};

template <bool KneeOfOne>
struct BoucWenKernel {
  static constexpr int parameters = 7;
  static constexpr int states = 1;
  using State = std::array<Lanes, states>;
  Lanes alpha, c0, k0, f0;
  Hysteresis<KneeOfOne> hysteresis;

  [[gnu::always_inline]] void set(const Lanes* p) {
    alpha = p[0];
    c0 = p[1];
    k0 = p[2];
    f0 = p[3];
    hysteresis = {p[4], p[5], p[6]};
  }
  [[nodiscard, gnu::always_inline]] State rate(const State& s, double v) const {
    return {hysteresis.rate(s[0], Lanes(v))};
  }
  [[nodiscard, gnu::always_inline]] Lanes force(const State& s, double x, double v) const {
    return fma(alpha, s[0], fma(k0, Lanes(x), fma(c0, Lanes(v), f0)));
  }
};

template <bool KneeOfOne>
struct ModifiedBoucWenKernel {
  static constexpr int parameters = 9;
  static constexpr int states = 2;
  using State = std::array<Lanes, states>;
  Lanes by_v, by_e, by_z, c1, k1, offset;
  Hysteresis<KneeOfOne> hysteresis;

  [[gnu::always_inline]] void set(const Lanes* p) {
    const Lanes series = Lanes(1.0) / (p[1] + p[2]);
    by_v = p[2] * series;
    by_e = p[3] * series;
    by_z = p[0] * series;
    c1 = p[2];
    k1 = p[4];
    offset = -p[4] * p[8];
    hysteresis = {p[5], p[6], p[7]};
  }
  [[nodiscard, gnu::always_inline]] Lanes slip(const State& s, double v) const {
    return fma(-by_z, s[1], fma(-by_e, s[0], by_v * Lanes(v)));
  }
  [[nodiscard, gnu::always_inline]] State rate(const State& s, double v) const {
    const Lanes u = slip(s, v);
    return {u, hysteresis.rate(s[1], u)};
  }
  [[nodiscard, gnu::always_inline]] Lanes force(const State& s, double x, double v) const {
    return fma(c1, Lanes(v) - slip(s, v), fma(k1, Lanes(x), offset));
  }
};

// Packs go through every stage together: one waits for its last result while the other computes.
template <class Kernel, int Packs>
[[gnu::flatten]] void march(const PlainMotion& motion, const Lanes* p, Lanes* out) {
  using State = typename Kernel::State;
  std::array<Kernel, Packs> kernel;
  std::array<State, Packs> state;
  repeat<Packs>([&](auto k) __attribute__((always_inline)) { kernel[k].set(p + k * Kernel::parameters); });
  const Lanes half(0.5 * motion.step);
  const Lanes whole(motion.step);
  const Lanes sixth(motion.step / 6.0);
  const auto stage = [&](std::array<State, Packs> & rates, const Lanes& ahead, const std::array<State, Packs>& before,
                         double v) __attribute__((always_inline)) {
    repeat<Packs>([&](auto k) __attribute__((always_inline)) {
      State at;
      repeat<Kernel::states>([&](auto i)
                                 __attribute__((always_inline)) { at[i] = fma(ahead, before[k][i], state[k][i]); });
      rates[k] = kernel[k].rate(at, v);
    });
  };
  for (std::size_t n = 0; n < motion.x.size(); ++n) {
    repeat<Packs>([&](auto k) __attribute__((always_inline)) {
      out[n * Packs + k] = kernel[k].force(state[k], motion.x[n], motion.v[n]);
    });
    if (n + 1 == motion.x.size()) break;
    std::array<State, Packs> k1;
    std::array<State, Packs> k2;
    std::array<State, Packs> k3;
    std::array<State, Packs> k4;
    repeat<Packs>([&](auto k) __attribute__((always_inline)) { k1[k] = kernel[k].rate(state[k], motion.v[n]); });
    stage(k2, half, k1, motion.middle[n]);
    stage(k3, half, k2, motion.middle[n]);
    stage(k4, whole, k3, motion.v[n + 1]);
    repeat<Packs>([&](auto k) __attribute__((always_inline)) {
      repeat<Kernel::states>([&](auto i) __attribute__((always_inline)) {
        const Lanes sum = fma(Lanes(2.0), k2[k][i] + k3[k][i], k1[k][i] + k4[k][i]);
        state[k][i] = fma(sixth, sum, state[k][i]);
      });
    });
  }
}

template <template <bool> class Kernel>
FusedKernel choose(bool knee_of_one, int packs) {
  if (packs == 1) return knee_of_one ? march<Kernel<true>, 1> : march<Kernel<false>, 1>;
  return knee_of_one ? march<Kernel<true>, 2> : march<Kernel<false>, 2>;
}

}  // namespace

PlainMotion::PlainMotion(const Motion& motion) : step(motion.intervals.at(0).length), x(motion.x), v(motion.v) {
  for (const MotionInterval& interval : motion.intervals) {
    middle.push_back(interval.middle[1]);
  }
}

FusedKernel fused_kernel(std::string_view law, bool knee_of_one, int packs) {
  if (law == "bouc-wen") return choose<BoucWenKernel>(knee_of_one, packs);
  if (law == "modified-bouc-wen") return choose<ModifiedBoucWenKernel>(knee_of_one, packs);
  return nullptr;
}

}  // namespace hysteron::bench
