#include "respond/one_period.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/extent.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 8;
constexpr double alike = 1e-3;  // of the range

// The largest third difference of six samples: at a crest a sample that is there twice shows in these only.
double roughness(const std::array<double, 6>& y) {
  double result = 0.0;
  for (std::size_t n = 3; n < y.size(); ++n) {
    result = std::max(result, std::fabs(y[n] - 3.0 * y[n - 1] + 3.0 * y[n - 2] - y[n - 3]));
  }
  return result;
}

// The last sample is a step short of it.
double period_of(std::span<const double> time) {
  return (time.back() - time.front()) * static_cast<double>(time.size()) / static_cast<double>(time.size() - 1);
}

}  // namespace

bool last_repeats_first(std::span<const double> values) {
  const std::size_t size = values.size();
  if (size < fewest_samples || std::fabs(values[size - 1] - values[0]) > alike * span_of(values)) {
    return false;
  }
  const double kept =
      roughness({values[size - 3], values[size - 2], values[size - 1], values[0], values[1], values[2]});
  const double dropped =
      roughness({values[size - 4], values[size - 3], values[size - 2], values[0], values[1], values[2]});
  return dropped < kept;
}

double end_of_periods(std::span<const double> time, int count) { return time.front() + count * period_of(time); }

std::vector<double> repeated_times(std::span<const double> time, int count) {
  const double period = period_of(time);
  std::vector<double> result;
  for (int k = 0; k < count; ++k) {
    for (const double t : time) {
      result.push_back(t + k * period);
    }
  }
  return result;
}

}  // namespace hysteron
