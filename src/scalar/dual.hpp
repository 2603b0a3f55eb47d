// A value with N directional derivatives, over double or a pack: forward-mode differentiation.
#pragma once

#include "scalar/lanes.hpp"

namespace hysteron {

template <class S, int N>
struct Dual {
  static constexpr int directions = N;
  S v{};
  S d[N]{};

  Dual() = default;
  [[gnu::always_inline]] Dual(const Dual& o) : v(o.v) {
    repeat<N>([&](auto i) __attribute__((always_inline)) { d[i] = o.d[i]; });
  }
  [[gnu::always_inline]] Dual& operator=(const Dual& o) {
    v = o.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { d[i] = o.d[i]; });
    return *this;
  }
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely in model equations
  [[gnu::always_inline]] Dual(double value) : v(value) {}
  [[gnu::always_inline]] explicit Dual(const S& value) requires(!std::is_same_v<S, double>) : v(value) {}

  [[gnu::always_inline]] Dual& operator+=(const Dual& o) { return *this = *this + o; }
  [[gnu::always_inline]] Dual& operator-=(const Dual& o) { return *this = *this - o; }
  [[gnu::always_inline]] Dual& operator*=(const Dual& o) { return *this = *this * o; }

  [[gnu::always_inline]] friend Dual operator+(Dual a, const Dual& b) {
    a.v = a.v + b.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { a.d[i] = a.d[i] + b.d[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Dual operator-(Dual a, const Dual& b) {
    a.v = a.v - b.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { a.d[i] = a.d[i] - b.d[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    r.v = a.v * b.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { r.d[i] = fma(a.v, b.d[i], a.d[i] * b.v); });
    return r;
  }
  [[gnu::always_inline]] friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    r.v = a.v / b.v;
    const S inverse = S(1.0) / b.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { r.d[i] = (a.d[i] - r.v * b.d[i]) * inverse; });
    return r;
  }
  [[gnu::always_inline]] friend Dual operator-(Dual a) {
    a.v = -a.v;
    repeat<N>([&](auto i) __attribute__((always_inline)) { a.d[i] = -a.d[i]; });
    return a;
  }
  [[gnu::always_inline]] friend auto operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  [[gnu::always_inline]] friend auto operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
};

// f(a) given its value and slope.
template <class S, int N>
[[gnu::always_inline]] inline Dual<S, N> chain(const Dual<S, N>& a, const S& value, const S& slope) {
  Dual<S, N> r;
  r.v = value;
  repeat<N>([&](auto i) __attribute__((always_inline)) { r.d[i] = slope * a.d[i]; });
  return r;
}

template <class M, class S, int N>
[[gnu::always_inline]] inline Dual<S, N> select(const M& mask, Dual<S, N> yes, const Dual<S, N>& no) {
  yes.v = select(mask, yes.v, no.v);
  repeat<N>([&](auto i) __attribute__((always_inline)) { yes.d[i] = select(mask, yes.d[i], no.d[i]); });
  return yes;
}

// The value rounds as the plain scalar's fma does.
template <class S, int N>
[[gnu::always_inline]] inline Dual<S, N> fma(const Dual<S, N>& a, const Dual<S, N>& b, const Dual<S, N>& c) {
  Dual<S, N> r;
  r.v = fma(a.v, b.v, c.v);
  repeat<N>([&](auto i) __attribute__((always_inline)) { r.d[i] = fma(a.v, b.d[i], fma(a.d[i], b.v, c.d[i])); });
  return r;
}

template <class S, int N>
[[gnu::always_inline]] inline Dual<S, N> abs(const Dual<S, N>& a) {
  return chain(a, abs(a.v), select(a.v < S(0.0), S(-1.0), S(1.0)));
}

template <class S, int N>
[[gnu::always_inline]] inline Dual<S, N> sqrt(const Dual<S, N>& a) {
  const S root = sqrt(a.v);
  return chain(a, root, select(root > S(0.0), S(0.5) / root, S(0.0)));
}

template <class T>
struct ValueOf {
  using type = T;
};
template <class S, int N>
struct ValueOf<Dual<S, N>> {
  using type = S;
};
// The scalar without its derivatives.
template <class T>
using value_t = typename ValueOf<T>::type;

template <class T>
[[gnu::always_inline]] inline const T& value_of(const T& a) {
  return a;
}
template <class S, int N>
[[gnu::always_inline]] inline const S& value_of(const Dual<S, N>& a) {
  return a.v;
}

}  // namespace hysteron
