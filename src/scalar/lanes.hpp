// A pack of eight independent simulations (candidates), one per lane. Every operation is element-wise IEEE
// arithmetic, so a lane rounds exactly as a scalar double does, on any instruction set and in any company.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace hysteron {

#if defined(__AVX512F__)
inline constexpr std::size_t vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t vector_bytes = 32;
#else
inline constexpr std::size_t vector_bytes = 16;
#endif

using VectorDouble [[gnu::vector_size(vector_bytes)]] = double;
using VectorInt [[gnu::vector_size(vector_bytes)]] = std::int64_t;
using VectorUnsigned [[gnu::vector_size(vector_bytes)]] = std::uint64_t;

inline constexpr int lane_count = 8;
inline constexpr int vectors_per_pack = lane_count * static_cast<int>(sizeof(double)) / static_cast<int>(vector_bytes);

// Calls f with the compile-time indices 0 .. N-1: constant indices let the compiler keep a pack in registers.
template <int N, class F>
[[gnu::always_inline]] inline void repeat(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, I>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

struct LaneMask {
  VectorInt m[vectors_per_pack];
};

struct Lanes {
  VectorDouble v[vectors_per_pack];

  [[gnu::always_inline]] Lanes() : Lanes(0.0) {}
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely in model equations
  [[gnu::always_inline]] Lanes(double value) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { v[i] = value - VectorDouble{}; });
  }
  // Copies go vector by vector: GCC would move the aggregate in 16-byte pieces, and reading those back as one vector
  // stalls on store forwarding.
  [[gnu::always_inline]] Lanes(const Lanes& o) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { v[i] = o.v[i]; });
  }
  [[gnu::always_inline]] Lanes& operator=(const Lanes& o) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { v[i] = o.v[i]; });
    return *this;
  }
  [[nodiscard]] double lane(int index) const {
    constexpr int per = lane_count / vectors_per_pack;
    return v[index / per][index % per];
  }
  void set_lane(int index, double value) {
    constexpr int per = lane_count / vectors_per_pack;
    v[index / per][index % per] = value;
  }

  [[gnu::always_inline]] Lanes& operator+=(const Lanes& o) { return *this = *this + o; }
  [[gnu::always_inline]] Lanes& operator-=(const Lanes& o) { return *this = *this - o; }
  [[gnu::always_inline]] Lanes& operator*=(const Lanes& o) { return *this = *this * o; }

  [[gnu::always_inline]] friend Lanes operator+(Lanes a, const Lanes& b) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] + b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a, const Lanes& b) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] - b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Lanes operator*(Lanes a, const Lanes& b) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] * b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Lanes operator/(Lanes a, const Lanes& b) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] / b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a) {
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.v[i] = -a.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend LaneMask operator<(const Lanes& a, const Lanes& b) {
    LaneMask r;
    repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { r.m[i] = a.v[i] < b.v[i]; });
    return r;
  }
  [[gnu::always_inline]] friend LaneMask operator>(const Lanes& a, const Lanes& b) { return b < a; }
};

[[gnu::always_inline]] inline LaneMask operator&(LaneMask a, const LaneMask& b) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.m[i] &= b.m[i]; });
  return a;
}
[[gnu::always_inline]] inline LaneMask operator|(LaneMask a, const LaneMask& b) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { a.m[i] |= b.m[i]; });
  return a;
}

[[gnu::always_inline]] inline Lanes select(const LaneMask& mask, Lanes yes, const Lanes& no) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) { yes.v[i] = mask.m[i] ? yes.v[i] : no.v[i]; });
  return yes;
}
[[gnu::always_inline]] inline double select(bool mask, double yes, double no) { return mask ? yes : no; }

[[gnu::always_inline]] inline bool any(const LaneMask& mask) {
  VectorInt all = mask.m[0];
  for (int i = 1; i < vectors_per_pack; ++i) {
    all |= mask.m[i];
  }
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(all), reinterpret_cast<__m512i>(all)) != 0;
#elif defined(__AVX__)
  return _mm256_testz_si256(reinterpret_cast<__m256i>(all), reinterpret_cast<__m256i>(all)) == 0;
#else
  return (all[0] | all[1]) != 0;
#endif
}
[[gnu::always_inline]] inline bool any(bool mask) { return mask; }

// a b + c with one rounding, in every lane; with two in WebAssembly, which has no such instruction.
[[gnu::always_inline]] inline Lanes fma(Lanes a, const Lanes& b, const Lanes& c) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
    a.v[i] = _mm512_fmadd_pd(a.v[i], b.v[i], c.v[i]);
#elif defined(__FMA__)
    a.v[i] = _mm256_fmadd_pd(a.v[i], b.v[i], c.v[i]);
#elif defined(__wasm__)
    a.v[i] = a.v[i] * b.v[i] + c.v[i];
#else
    for (std::size_t k = 0; k < vector_bytes / sizeof(double); ++k) {
      a.v[i][k] = std::fma(a.v[i][k], b.v[i][k], c.v[i][k]);
    }
#endif
  });
  return a;
}
[[gnu::always_inline]] inline double fma(double a, double b, double c) {
#ifdef __wasm__
  return a * b + c;
#else
  return std::fma(a, b, c);
#endif
}

// b < a ? b : a and a < b ? b : a, also for NaN and signed zeros: what the instructions do, operands swapped. The masks
// leave no lane out: GCC 12 takes the unmasked forms for uses of an uninitialised variable (GCC bug 105593).
[[gnu::always_inline]] inline Lanes smaller(Lanes a, const Lanes& b) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
    a.v[i] = _mm512_mask_min_pd(b.v[i], 0xff, b.v[i], a.v[i]);
#elif defined(__AVX__)
    a.v[i] = _mm256_min_pd(b.v[i], a.v[i]);
#else
    a.v[i] = b.v[i] < a.v[i] ? b.v[i] : a.v[i];
#endif
  });
  return a;
}
[[gnu::always_inline]] inline Lanes larger(Lanes a, const Lanes& b) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
    a.v[i] = _mm512_mask_max_pd(b.v[i], 0xff, b.v[i], a.v[i]);
#elif defined(__AVX__)
    a.v[i] = _mm256_max_pd(b.v[i], a.v[i]);
#else
    a.v[i] = a.v[i] < b.v[i] ? b.v[i] : a.v[i];
#endif
  });
  return a;
}

[[gnu::always_inline]] inline Lanes abs(Lanes a) {
  repeat<vectors_per_pack>([&](auto i) __attribute__((always_inline)) {
    a.v[i] = reinterpret_cast<VectorDouble>(reinterpret_cast<VectorInt>(a.v[i]) & 0x7fffffffffffffffLL);
  });
  return a;
}
[[gnu::always_inline]] inline double abs(double a) { return std::fabs(a); }

[[gnu::always_inline]] inline Lanes sqrt(Lanes a) {
  for (int i = 0; i < lane_count; ++i) {
    a.set_lane(i, std::sqrt(a.lane(i)));
  }
  return a;
}
[[gnu::always_inline]] inline double sqrt(double a) { return std::sqrt(a); }

[[gnu::always_inline]] inline double lane_of(const Lanes& a, int index) { return a.lane(index); }
[[gnu::always_inline]] inline double lane_of(double a, int /*index*/) { return a; }

}  // namespace hysteron
