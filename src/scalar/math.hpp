// Elementary functions written once for doubles, packs and dual numbers, so that all of them round alike; no libm.
// Polynomials interpolate at Chebyshev nodes of the reduced range. Relative error of exp and log is below 4e-16, of pow
// below 1e-15 (1 + |n log a|), of tanh below 1e-15 (tests/scalar).
#pragma once

#include <bit>
#include <type_traits>

#include "scalar/dual.hpp"
#include "scalar/lanes.hpp"

namespace hysteron {

template <class T>
[[gnu::always_inline]] inline T min(const T& a, const T& b) {
  if constexpr (is_pack<T>) {
    return smaller(a, b);
  } else {
    return select(b < a, b, a);
  }
}
template <class T>
[[gnu::always_inline]] inline T max(const T& a, const T& b) {
  if constexpr (is_pack<T>) {
    return larger(a, b);
  } else {
    return select(a < b, b, a);
  }
}
template <class T>
[[gnu::always_inline]] inline T sign(const T& a) {
  return select(a < T(0.0), T(-1.0), select(a > T(0.0), T(1.0), T(0.0)));
}

namespace detail {

// mantissa * 2^k, where `shifted` holds k + 1.5 * 2^52 so that k stands in its low bits. Bits are unsigned here and
// below: lanes whose result is not taken may hold anything, and wrap.
[[gnu::always_inline]] inline double scale(double mantissa, double shifted) {
  const auto k = std::bit_cast<std::uint64_t>(shifted) << 52;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(mantissa) + k);
}
template <int Vectors>
[[gnu::always_inline]] inline Pack<Vectors> scale(Pack<Vectors> mantissa, const Pack<Vectors>& shifted) {
  repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
    const VectorUnsigned k = reinterpret_cast<VectorUnsigned>(shifted.v[i]) << 52;
    mantissa.v[i] = reinterpret_cast<VectorDouble>(reinterpret_cast<VectorUnsigned>(mantissa.v[i]) + k);
  });
  return mantissa;
}

// Splits a positive normal number into mantissa in [sqrt(1/2), sqrt(2)) and exponent.
[[gnu::always_inline]] inline void split(double a, double& mantissa, double& exponent) {
  constexpr std::uint64_t half_root = 0x3fe6a09e667f3bcdULL;  // bits of sqrt(1/2)
  const auto bits = std::bit_cast<std::uint64_t>(a);
  const std::uint64_t e = (bits - half_root) & ~0xfffffffffffffULL;
  mantissa = std::bit_cast<double>(bits - e);
  exponent = std::bit_cast<double>((static_cast<std::int64_t>(e) >> 52) + 0x4338000000000000LL) - 0x1.8p52;
}
template <int Vectors>
[[gnu::always_inline]] inline void split(const Pack<Vectors>& a, Pack<Vectors>& mantissa, Pack<Vectors>& exponent) {
  constexpr std::uint64_t half_root = 0x3fe6a09e667f3bcdULL;
  repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
    const VectorUnsigned bits = reinterpret_cast<VectorUnsigned>(a.v[i]);
    const VectorUnsigned e = (bits - half_root) & ~0xfffffffffffffULL;
    mantissa.v[i] = reinterpret_cast<VectorDouble>(bits - e);
    // AVX2 has no 64-bit arithmetic shift: a logical one and a bias do the same for |exponent| < 1024.
    const VectorUnsigned biased = (e + (1024ULL << 52)) >> 52;
    exponent.v[i] = reinterpret_cast<VectorDouble>(biased + 0x4338000000000000ULL) - (0x1.8p52 + 1024.0);
  });
}

// x = k log 2 + r with `shifted` as scale wants it; the result is exp r - 1 = r + r^2 q(r), q by Estrin's scheme: the
// march waits for its results, and Estrin's chains are half as long as Horner's.
template <class T>
struct Reduced {
  T shifted;
  T r;
  T r2;
  T q;
};
template <class T>
[[gnu::always_inline]] inline Reduced<T> reduce(const T& x) {
  const T shifted = fma(x, T(1.4426950408889634074), T(0x1.8p52));
  const T k = shifted - T(0x1.8p52);
  const T r = fma(k, T(-1.90821492927058770002e-10), fma(k, T(-6.93147180369123816490e-01), x));
  const T r2 = r * r;
  const T r4 = r2 * r2;
  const T low = fma(fma(T(0.008333333333330032), r, T(0.04166666666662374)), r2,
                    fma(T(0.16666666666666669), r, T(0.5000000000000001)));
  const T high = fma(fma(T(2.7557268229963227e-06), r, T(2.4801520996825697e-05)), r2,
                     fma(T(0.00019841269863201828), r, T(0.0013888888917406447)));
  const T top = fma(T(2.5100494788905042e-08), r, T(2.76202305675069e-07));
  return {shifted, r, r2, fma(fma(top, r4, high), r4, low)};
}

// Limited to the results at -708 and 709; limiting the result keeps the comparisons off the chain of dependences.
template <class T>
[[gnu::always_inline]] inline T exp_value(const T& x) {
  const Reduced<T> part = reduce(x);
  const T inside = scale(fma(part.q, part.r2, part.r + T(1.0)), part.shifted);
  return select(x > T(709.0), T(8.218407461554972e+307), select(x < T(-708.0), T(3.307553003638408e-308), inside));
}

// Natural logarithm of a positive normal number.
template <class T>
[[gnu::always_inline]] inline T log_value(const T& a) {
  T m;
  T e;
  split(a, m, e);
  const T s = (m - T(1.0)) / (m + T(1.0));
  const T q = s * s;
  const T q2 = q * q;
  const T low = fma(fma(T(0.1111110555757208), q, T(0.14285714313047945)), q2,
                    fma(T(0.1999999999994962), q, T(0.3333333333333335)));
  const T high = fma(T(0.07308518774395825), q2, fma(T(0.0766583701508393), q, T(0.09091445278347801)));
  const T p = fma(high, q2 * q2, low);
  const T twice = T(2.0) * s;
  const T rest = fma(p, q * twice, e * T(1.90821492927058770002e-10));
  return fma(e, T(6.93147180369123816490e-01), twice) + rest;
}

// (exp 2|a| - 1) / (exp 2|a| + 1); exp - 1 is formed without cancellation, and 1 is reached exactly before the limit.
template <class T>
[[gnu::always_inline]] inline T tanh_value(const T& a) {
  const Reduced<T> part = reduce(min(T(2.0) * abs(a), T(80.0)));
  const T power = scale(T(1.0), part.shifted);
  const T less_one = fma(power, fma(part.q, part.r2, part.r), power - T(1.0));
  const T result = less_one / (less_one + T(2.0));
  return select(a < T(0.0), -result, result);
}

inline constexpr double tiny = 1e-300;

}  // namespace detail

template <class T>
[[gnu::always_inline]] inline T exp(const T& a) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    return detail::exp_value(a);
  } else {
    const auto value = detail::exp_value(a.v);
    return chain(a, value, value);
  }
}

// log of max(a, 1e-300).
template <class T>
[[gnu::always_inline]] inline T log(const T& a) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    return detail::log_value(max(a, T(detail::tiny)));
  } else {
    using S = value_t<T>;
    const S safe = max(a.v, S(detail::tiny));
    return chain(a, detail::log_value(safe), S(1.0) / safe);
  }
}

// a^n for a >= 0; zero where a is below 1e-300.
template <class T>
[[gnu::always_inline]] inline T pow(const T& a, const T& n) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    const T power = detail::exp_value(n * detail::log_value(max(a, T(detail::tiny))));
    return select(a < T(detail::tiny), T(0.0), power);
  } else {
    using S = value_t<T>;
    const S safe = max(a.v, S(detail::tiny));
    const S logarithm = detail::log_value(safe);
    const auto zero = a.v < S(detail::tiny);
    const S value = select(zero, S(0.0), detail::exp_value(n.v * logarithm));
    const S by_base = select(zero, S(0.0), n.v * value / safe);
    const S by_exponent = select(zero, S(0.0), value * logarithm);
    T r;
    r.v = value;
    repeat<T::directions>([&](auto i)
                              __attribute__((always_inline)) { r.d[i] = fma(by_base, a.d[i], by_exponent * n.d[i]); });
    return r;
  }
}

// a^n for a >= 0 with the exponents 1 and 2 exact and cheap: the usual fixed values of hysteresis models.
template <class T>
[[gnu::always_inline]] inline T power_law(const T& a, const T& n) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    const auto not_one = (n < T(1.0)) | (n > T(1.0));
    if (!any(not_one)) {
      return a;
    }
    const auto not_two = (n < T(2.0)) | (n > T(2.0));
    T result = select(not_one, a * a, a);
    const auto general = not_one & not_two;
    if (any(general)) {
      result = select(general, pow(a, n), result);
    }
    return result;
  } else {
    // Each lane takes the branch-free results below whether or not a neighbour needs the logarithm.
    using S = value_t<T>;
    const auto not_one = (n.v < S(1.0)) | (n.v > S(1.0));
    const auto not_two = (n.v < S(2.0)) | (n.v > S(2.0));
    T r;
    r.v = select(not_one, a.v * a.v, a.v);
    S by_base = select(not_one, S(2.0) * a.v, S(1.0));
    const auto general = not_one & not_two;
    auto moving = general;
    repeat<T::directions>([&](auto i) __attribute__((always_inline)) {
      moving = moving | (n.d[i] < S(0.0)) | (n.d[i] > S(0.0));
    });
    if (any(moving)) {
      const S safe = max(a.v, S(detail::tiny));
      const auto zero = a.v < S(detail::tiny);
      const S logarithm = detail::log_value(safe);
      const S power = select(zero, S(0.0), detail::exp_value(n.v * logarithm));
      r.v = select(general, power, r.v);
      by_base = select(general, select(zero, S(0.0), n.v * power / safe), by_base);
      const S by_exponent = select(zero, S(0.0), r.v * logarithm);
      repeat<T::directions>([&](auto i) __attribute__((always_inline)) {
        r.d[i] = fma(by_base, a.d[i], by_exponent * n.d[i]);
      });
    } else {
      repeat<T::directions>([&](auto i) __attribute__((always_inline)) { r.d[i] = by_base * a.d[i]; });
    }
    return r;
  }
}

template <class T>
[[gnu::always_inline]] inline T tanh(const T& a) {
  if constexpr (std::is_same_v<T, value_t<T>>) {
    return detail::tanh_value(a);
  } else {
    using S = value_t<T>;
    const S value = detail::tanh_value(a.v);
    return chain(a, value, S(1.0) - value * value);
  }
}

}  // namespace hysteron
