// Solvers take a cost of diverged_cost or more (fit/solver.hpp) for a point that has none. An objective of the user's
// own may have finite values of any size: the large ones are drawn together below that, in their order.
#pragma once

#include <vector>

namespace hysteron {

class CostRange {
 public:
  // What solvers are told of a value: itself where it is moderate, beyond that its logarithm with the same slope there.
  double told(double value);
  // The value behind a cost that was the lowest when it was told.
  [[nodiscard]] double value_of(double told) const;

 private:
  struct Lowest {
    double told;
    double value;
  };
  std::vector<Lowest> lowest_;  // each lower than the one before it
};

}  // namespace hysteron
