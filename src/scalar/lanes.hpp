// Packs of independent simulations (candidates), one per lane: eight, or sixteen where two packs go side by side. Every
// operation is element-wise IEEE arithmetic, so a lane rounds exactly as a scalar double does, on any instruction set
// and in any company.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#if defined(__AVX__) && (defined(__AVX512F__) || defined(__clang__))
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

#if defined(__AVX__) && !defined(__AVX512F__)
// GCC's header of all intrinsics is 1.8 MB, a third of what most files would read. These are what it would give.
namespace instruction {
#if defined(__clang__)
[[gnu::always_inline]] inline bool all_zero(VectorInt a) {
  return _mm256_testz_si256(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(a)) != 0;
}
[[gnu::always_inline]] inline VectorDouble min(VectorDouble a, VectorDouble b) { return _mm256_min_pd(a, b); }
[[gnu::always_inline]] inline VectorDouble max(VectorDouble a, VectorDouble b) { return _mm256_max_pd(a, b); }
#if defined(__FMA__)
[[gnu::always_inline]] inline VectorDouble multiply_add(VectorDouble a, VectorDouble b, VectorDouble c) {
  return _mm256_fmadd_pd(a, b, c);
}
#endif
#else
using VectorLong [[gnu::vector_size(32)]] = long long;
[[gnu::always_inline]] inline bool all_zero(VectorInt a) {
  return __builtin_ia32_ptestz256(reinterpret_cast<VectorLong>(a), reinterpret_cast<VectorLong>(a)) != 0;
}
[[gnu::always_inline]] inline VectorDouble min(VectorDouble a, VectorDouble b) { return __builtin_ia32_minpd256(a, b); }
[[gnu::always_inline]] inline VectorDouble max(VectorDouble a, VectorDouble b) { return __builtin_ia32_maxpd256(a, b); }
#if defined(__FMA__)
[[gnu::always_inline]] inline VectorDouble multiply_add(VectorDouble a, VectorDouble b, VectorDouble c) {
  return __builtin_ia32_vfmaddpd256(a, b, c);
}
#endif
#endif
}  // namespace instruction
#endif

// Calls f with the compile-time indices 0 .. N-1: constant indices let the compiler keep a pack in registers.
template <int N, class F>
[[gnu::always_inline]] inline void repeat(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (f(std::integral_constant<int, I>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

// True or false in every lane.
template <int Vectors>
struct PackMask {
  VectorInt m[Vectors];

  [[gnu::always_inline]] friend PackMask operator&(PackMask a, const PackMask& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.m[i] &= b.m[i]; });
    return a;
  }
  [[gnu::always_inline]] friend PackMask operator|(PackMask a, const PackMask& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.m[i] |= b.m[i]; });
    return a;
  }
  [[gnu::always_inline]] friend bool any(const PackMask& mask) {
    VectorInt all = mask.m[0];
    for (int i = 1; i < Vectors; ++i) {
      all |= mask.m[i];
    }
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(all), reinterpret_cast<__m512i>(all)) != 0;
#elif defined(__AVX__)
    return !instruction::all_zero(all);
#else
    return (all[0] | all[1]) != 0;
#endif
  }
};

template <int Vectors>
struct Pack {
  static constexpr int vectors = Vectors;
  static constexpr int lanes_per_vector = static_cast<int>(vector_bytes / sizeof(double));
  static constexpr int lanes = Vectors * lanes_per_vector;
  using Mask = PackMask<Vectors>;

  VectorDouble v[Vectors];

  [[gnu::always_inline]] Pack() : Pack(0.0) {}
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely in model equations
  [[gnu::always_inline]] Pack(double value) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { v[i] = value - VectorDouble{}; });
  }
  // Copies go vector by vector: GCC would move the aggregate in 16-byte pieces, and reading those back as one vector
  // stalls on store forwarding.
  [[gnu::always_inline]] Pack(const Pack& o) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { v[i] = o.v[i]; });
  }
  [[gnu::always_inline]] Pack& operator=(const Pack& o) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { v[i] = o.v[i]; });
    return *this;
  }
  [[nodiscard]] double lane(int index) const { return v[index / lanes_per_vector][index % lanes_per_vector]; }
  void set_lane(int index, double value) { v[index / lanes_per_vector][index % lanes_per_vector] = value; }

  [[gnu::always_inline]] Pack& operator+=(const Pack& o) { return *this = *this + o; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& o) { return *this = *this - o; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& o) { return *this = *this * o; }

  [[gnu::always_inline]] friend Pack operator+(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] + b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Pack operator-(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] - b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Pack operator*(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] * b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Pack operator/(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.v[i] = a.v[i] / b.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Pack operator-(Pack a) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { a.v[i] = -a.v[i]; });
    return a;
  }
  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) {
    Mask r;
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { r.m[i] = a.v[i] < b.v[i]; });
    return r;
  }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) { return b < a; }

  [[gnu::always_inline]] friend Pack select(const Mask& mask, Pack yes, const Pack& no) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) { yes.v[i] = mask.m[i] ? yes.v[i] : no.v[i]; });
    return yes;
  }

  // a b + c with one rounding, in every lane; with two in WebAssembly, which has no such instruction.
  [[gnu::always_inline]] friend Pack fma(Pack a, const Pack& b, const Pack& c) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
      a.v[i] = _mm512_fmadd_pd(a.v[i], b.v[i], c.v[i]);
#elif defined(__FMA__)
      a.v[i] = instruction::multiply_add(a.v[i], b.v[i], c.v[i]);
#elif defined(__wasm__)
      a.v[i] = a.v[i] * b.v[i] + c.v[i];
#else
      for (int k = 0; k < lanes_per_vector; ++k) {
        a.v[i][k] = std::fma(a.v[i][k], b.v[i][k], c.v[i][k]);
      }
#endif
    });
    return a;
  }

  // b < a ? b : a and a < b ? b : a, also for NaN and signed zeros: what the instructions do, operands swapped. The
  // masks leave no lane out: GCC 12 takes the unmasked forms for uses of an uninitialised variable (GCC bug 105593).
  [[gnu::always_inline]] friend Pack smaller(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
      a.v[i] = _mm512_mask_min_pd(b.v[i], 0xff, b.v[i], a.v[i]);
#elif defined(__AVX__)
      a.v[i] = instruction::min(b.v[i], a.v[i]);
#else
      a.v[i] = b.v[i] < a.v[i] ? b.v[i] : a.v[i];
#endif
    });
    return a;
  }
  [[gnu::always_inline]] friend Pack larger(Pack a, const Pack& b) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
#if defined(__AVX512F__)
      a.v[i] = _mm512_mask_max_pd(b.v[i], 0xff, b.v[i], a.v[i]);
#elif defined(__AVX__)
      a.v[i] = instruction::max(b.v[i], a.v[i]);
#else
      a.v[i] = a.v[i] < b.v[i] ? b.v[i] : a.v[i];
#endif
    });
    return a;
  }

  [[gnu::always_inline]] friend Pack abs(Pack a) {
    repeat<Vectors>([&](auto i) __attribute__((always_inline)) {
      a.v[i] = reinterpret_cast<VectorDouble>(reinterpret_cast<VectorInt>(a.v[i]) & 0x7fffffffffffffffLL);
    });
    return a;
  }
  [[gnu::always_inline]] friend Pack sqrt(Pack a) {
    for (int i = 0; i < lanes; ++i) {
      a.set_lane(i, std::sqrt(a.lane(i)));
    }
    return a;
  }
  [[gnu::always_inline]] friend double lane_of(const Pack& a, int index) { return a.lane(index); }
};

inline constexpr int lane_count = 8;
inline constexpr int vectors_per_pack = lane_count * static_cast<int>(sizeof(double)) / static_cast<int>(vector_bytes);
using Lanes = Pack<vectors_per_pack>;
using LaneMask = Lanes::Mask;
// Two packs side by side: a march waits for its own last result, and the other half has work meanwhile.
using WideLanes = Pack<2 * vectors_per_pack>;
inline constexpr int wide_lane_count = WideLanes::lanes;
// With short vectors the registers do not hold them.
inline constexpr bool wide_lanes_pay = vectors_per_pack <= 2;

template <class T>
inline constexpr bool is_pack = false;
template <int Vectors>
inline constexpr bool is_pack<Pack<Vectors>> = true;

[[gnu::always_inline]] inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
[[gnu::always_inline]] inline bool any(bool mask) { return mask; }
[[gnu::always_inline]] inline double fma(double a, double b, double c) {
#ifdef __wasm__
  return a * b + c;
#else
  return std::fma(a, b, c);
#endif
}
[[gnu::always_inline]] inline double abs(double a) { return std::fabs(a); }
[[gnu::always_inline]] inline double sqrt(double a) { return std::sqrt(a); }
[[gnu::always_inline]] inline double lane_of(double a, int /*index*/) { return a; }

}  // namespace hysteron
