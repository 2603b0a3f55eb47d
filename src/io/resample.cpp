#include "io/resample.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace hysteron {
namespace {

constexpr std::size_t most_nodes = 8;
constexpr std::size_t fewest_nodes = 4;  // of a window that is not centred
// Steps of one window may differ by so much; polynomials of a high degree swing in wider ones.
constexpr double widest_ratio = 2.0;
// Of a step: a time as near to a sample as this is that sample's, as in 1 ms against ten times 0.1 ms.
constexpr double same = 1e-6;

struct Window {
  std::size_t first = 0;
  std::size_t count = 0;
};

bool even(std::span<const double> time, const Window& window) {
  double shortest = time[window.first + 1] - time[window.first];
  double longest = shortest;
  for (std::size_t k = 1; k + 1 < window.count; ++k) {
    const double step = time[window.first + k + 1] - time[window.first + k];
    shortest = std::min(shortest, step);
    longest = std::max(longest, step);
  }
  return longest <= widest_ratio * shortest;
}

// Samples around the interval that begins at sample k: centred as far as the ends allow.
Window window_at(std::span<const double> time, std::size_t k) {
  const std::size_t n = time.size();
  for (std::size_t half = std::min({most_nodes / 2, k + 1, n - 1 - k}); half > 1; --half) {
    const Window window{k + 1 - half, 2 * half};
    if (even(time, window)) return window;
  }
  if (n >= fewest_nodes && (k == 0 || k + 2 == n)) {
    const Window window{k == 0 ? 0 : n - fewest_nodes, fewest_nodes};
    if (even(time, window)) return window;
  }
  return {k, 2};
}

double lagrange(std::span<const double> time, std::span<const double> values, double t) {
  double sum = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < time.size(); ++j) {
      if (j != i) weight *= (t - time[j]) / (time[i] - time[j]);
    }
    sum += weight * values[i];
  }
  return sum;
}

}  // namespace

std::vector<double> resampled(std::span<const double> time, std::span<const double> values, std::span<const double> at,
                              Between between) {
  assert(time.size() == values.size() && time.size() >= 2);
  std::vector<double> result;
  result.reserve(at.size());
  std::size_t k = 0;  // the interval that t lies in
  Window window;
  std::size_t window_of = time.size();
  for (const double t : at) {
    while (k + 2 < time.size() && time[k + 1] <= t) ++k;
    const double step = time[k + 1] - time[k];
    if (t - time[k] <= same * step) {
      result.push_back(values[k]);
    } else if (time[k + 1] - t <= same * step) {
      result.push_back(values[k + 1]);
    } else if (between == Between::straight) {
      result.push_back(values[k] + (values[k + 1] - values[k]) * ((t - time[k]) / step));
    } else {
      if (window_of != k) {
        window = window_at(time, k);
        window_of = k;
      }
      result.push_back(
          lagrange(time.subspan(window.first, window.count), values.subspan(window.first, window.count), t));
    }
  }
  return result;
}

}  // namespace hysteron
