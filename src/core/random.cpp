#include "core/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

// Finaliser of splitmix64 (Steele, Lea, Flood 2014): mixes labels into a key.
std::uint64_t mix(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

struct Words {
  std::uint64_t first;
  std::uint64_t second;
};

Words philox(std::uint64_t key, std::uint64_t a, std::uint32_t b, std::uint32_t c) {
  r123::Philox4x32 generator;
  const r123::Philox4x32::key_type k = {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)}};
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32U), b, c}};
  const auto out = generator(counter, k);
  return {(static_cast<std::uint64_t>(out[1]) << 32U) | out[0], (static_cast<std::uint64_t>(out[3]) << 32U) | out[2]};
}

double to_unit(std::uint64_t word) { return (static_cast<double>(word >> 12U) + 0.5) * 0x1.0p-52; }

}  // namespace

Stream Stream::child(std::string_view label) const {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char letter : label) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  }
  return Stream(mix(mix(key_) ^ hash));
}

Stream Stream::child(std::uint64_t index) const { return Stream(mix(mix(key_ ^ 0x5851f42d4c957f2dULL) + index)); }

double Stream::uniform(std::uint64_t a, std::uint32_t b, std::uint32_t c) const {
  return to_unit(philox(key_, a, b, c).first);
}

double Stream::normal(std::uint64_t a, std::uint32_t b, std::uint32_t c) const {
  const Words words = philox(key_, a, b, c);
  return std::sqrt(-2.0 * std::log(to_unit(words.first))) * std::cos(2.0 * std::numbers::pi * to_unit(words.second));
}

std::uint64_t Stream::below(std::uint64_t n, std::uint64_t a, std::uint32_t b, std::uint32_t c) const {
  const auto index = static_cast<std::uint64_t>(uniform(a, b, c) * static_cast<double>(n));
  return index < n ? index : n - 1;
}

}  // namespace hysteron
