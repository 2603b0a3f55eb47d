// What the derivatives of a force on one target are taken by.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/layout.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Where drive and conditions are constant along a recording and no effect acts on it, the parameters are constant, and
// the derivatives by all nodes of a parameter's law are multiples of that by the parameter: one direction a law. Else
// one direction a coordinate.
struct Directions {
  struct Of {
    std::size_t direction;
    // d parameter / d node where the direction is a parameter of several nodes; the direction of one node carries the
    // slope of its coordinate itself.
    double weight = 1.0;
    bool shared = false;  // with other coordinates
  };
  bool by_parameter = false;
  std::size_t count = 0;
  std::vector<Of> of;  // each coordinate
};

Directions directions_of(const Layout& layout, const Target& target);

}  // namespace hysteron
