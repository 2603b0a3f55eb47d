// Draws in order from one random stream: every call takes the next number.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/random.hpp"

namespace hysteron::challenge {

class Draws {
 public:
  explicit Draws(Stream stream) : stream_(stream) {}
  Draws(const Stream& parent, std::string_view use) : stream_(parent.child(use)) {}

  double uniform(double low, double high) { return low + (high - low) * stream_.uniform(next_++); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, stream_.uniform(next_++)); }
  double normal() { return stream_.normal(next_++); }
  bool chance(double probability) { return stream_.uniform(next_++) < probability; }
  // An integer in [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(stream_.below(static_cast<std::uint64_t>(high - low) + 1, next_++));
  }
  template <class Items>
  const auto& pick(const Items& items) {
    return items[stream_.below(items.size(), next_++)];
  }

 private:
  Stream stream_;
  std::uint64_t next_ = 0;
};

}  // namespace hysteron::challenge
