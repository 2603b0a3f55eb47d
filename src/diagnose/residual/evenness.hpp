// Whether the size of what a fit leaves follows the motion. Noise, white or coloured, knows nothing of the motion: its
// size is the same wherever the damper is and however it moves. What a model misses mostly sits somewhere.
#pragma once

#include <array>
#include <cstdint>

#include "diagnose/residual/residuals.hpp"

namespace hysteron {

// Mean squared deviation, from 1, of the residual's mean square over classes of equal size of the displacement, the
// velocity, the force, their sizes, and the time since reversal, relative to that of the whole; the largest of these.
struct Evenness {
  double deviation = 0.0;
  double by_chance = 0.0;  // the most of nineteen surrogates (surrogate.hpp)
};

class EvennessSum {
 public:
  // `residual` in N, from its first sample that counts on; `scale` is what it is divided by.
  void add(const Recording& recording, const Residual& residual, double scale);
  [[nodiscard]] Evenness result() const;

 private:
  static constexpr std::size_t chances = 19;
  static constexpr std::size_t variables = 6;
  static constexpr std::size_t classes = 5;
  std::array<std::array<std::array<double, classes>, variables>, 1 + chances> squares_{};
  std::uint64_t added_ = 0;
};

// Whether chance does not explain what deviation there is.
inline bool uneven(const Evenness& evenness) { return evenness.deviation > 1.5 * evenness.by_chance; }
// Whether it does. Not known, and so not the case, where no recording had enough samples.
inline bool even(const Evenness& evenness) { return evenness.by_chance > 0.0 && !uneven(evenness); }

}  // namespace hysteron
