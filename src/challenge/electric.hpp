// From the commanded current to the one that magnetises the fluid.
#pragma once

#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

// The command through supply, coil, remanence and saturation as the parts have them, on a grid of 10 kHz that begins at
// `begin`; without such parts the command itself.
class Field {
 public:
  Field(const Physics& physics, const Drive& drive, double begin, double end);
  [[nodiscard]] double at(double t) const;

 private:
  const Drive& drive_;
  double begin_;
  std::vector<double> values_;  // empty: the command
};

}  // namespace hysteron::challenge
