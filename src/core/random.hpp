// Counter-based random streams: a draw is a pure function of what it is for, so results do not depend on
// thread count, order of evaluation or resuming. Philox4x32-10 of Random123 (Salmon et al. 2011,
// doi 10.1145/2063384.2063405) is the generator.
#pragma once

#include <cstdint>
#include <string_view>

namespace hysteron {

// A key derived from a master seed and words naming the use of the stream (dataset, model, solver, repeat).
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : key_(seed) {}
  // A child stream, independent of its parent and siblings.
  [[nodiscard]] Stream child(std::string_view label) const;
  [[nodiscard]] Stream child(std::uint64_t index) const;

  // Uniform in the open interval (0, 1), a pure function of (key, a, b, c): e.g. generation, individual, draw.
  [[nodiscard]] double uniform(std::uint64_t a, std::uint32_t b = 0, std::uint32_t c = 0) const;
  // Standard normal by Box-Muller, same addressing.
  [[nodiscard]] double normal(std::uint64_t a, std::uint32_t b = 0, std::uint32_t c = 0) const;
  // Uniform integer in [0, n).
  [[nodiscard]] std::uint64_t below(std::uint64_t n, std::uint64_t a, std::uint32_t b = 0, std::uint32_t c = 0) const;

 private:
  std::uint64_t key_;
};

}  // namespace hysteron
