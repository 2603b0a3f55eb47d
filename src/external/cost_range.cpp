#include "external/cost_range.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fit/solver.hpp"

namespace hysteron {
namespace {

// Up to here values stay as they are. The largest double, 1.8e308, comes to 694 times that, which diverged_cost is
// above.
constexpr double moderate = 1e-3 * diverged_cost;

}  // namespace

double CostRange::told(double value) {
  const double size = std::fabs(value);
  const double result = size <= moderate ? value : std::copysign(moderate * (1.0 + std::log(size / moderate)), value);
  if (lowest_.empty() || result < lowest_.back().told) lowest_.push_back({result, value});
  return result;
}

double CostRange::value_of(double told) const {
  const auto found = std::ranges::lower_bound(lowest_, told, std::greater<>(), &Lowest::told);
  return found != lowest_.end() && found->told == told ? found->value : told;
}

}  // namespace hysteron
