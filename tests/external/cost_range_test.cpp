// Values of an objective of the user's own in the range that solvers take for costs.
#include "external/cost_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/solver.hpp"

namespace hysteron {
namespace {

TEST(CostRange, ModerateValuesAreToldAsTheyAre) {
  CostRange range;
  for (const double value : {0.0, 1e-300, 0.3, -2.0, 1e7, -1e7}) EXPECT_EQ(range.told(value), value);
}

TEST(CostRange, LargeOnesKeepTheirOrderBelowThatOfNoCost) {
  CostRange range;
  double before = range.told(-std::numeric_limits<double>::max());
  EXPECT_GT(before, -diverged_cost);
  for (const double value : {-1e300, -1e10, -1e7, -1.0, 0.0, 9.999e6, 1e7, 1.0001e7, 1e10, 1.0000001e10, 1e100, 1e300,
                             std::numeric_limits<double>::max()}) {
    const double told = range.told(value);
    EXPECT_GT(told, before) << value;
    before = told;
  }
  EXPECT_LT(before, diverged_cost);
}

TEST(CostRange, TheLowestValueIsKnownAgain) {
  CostRange range;
  for (const double value : {1e200, 3.3e10, 4e10, 123.0, 5e9, -8e30}) {
    const double told = range.told(value);
    const bool lowest = value != 4e10 && value != 5e9;
    EXPECT_TRUE(!lowest || range.value_of(told) == value) << value;
  }
  EXPECT_EQ(range.value_of(range.told(-8e30)), -8e30);
}

}  // namespace
}  // namespace hysteron
