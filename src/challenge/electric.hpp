// From the commanded current to the one that magnetises the fluid.
#pragma once

#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

// Coil lag with different time constants up and down, exact over each step; then the play of the magnetic circuit;
// then saturation (2/pi) i_s atan(pi i / (2 i_s)). On a grid of 10 kHz that begins at `begin`.
class Field {
 public:
  Field(const Physics& physics, const Drive& drive, double begin, double end);
  [[nodiscard]] double at(double t) const;

 private:
  double begin_;
  std::vector<double> values_;
};

}  // namespace hysteron::challenge
